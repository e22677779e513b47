#include "operators/reflectance.hpp"

#include "foundation/error.hpp"

namespace radiosity {

void check_reflectance(const Eigen::MatrixXd& reflectance, Index n) {
  if (reflectance.rows() != n || reflectance.cols() < 1)
    fail<UsageError>(
        "a reflectance of {} x {} does not fit {} patches: give one row a patch, one column a channel",
        reflectance.rows(), reflectance.cols(), n);
  for (Index c = 0; c < reflectance.cols(); ++c)
    for (Index i = 0; i < n; ++i)
      if (!(reflectance(i, c) >= 0 && reflectance(i, c) <= 1))
        fail<UsageError>("patch {} has reflectance {} in channel {}: it must be in [0, 1]", i,
                         reflectance(i, c), c);
}

void add_product(const Eigen::ArrayXXd& diagonals, const ConstFieldRef& product, double beta, FieldRef Y) {
  for (Index j = 0; j < Y.cols(); ++j) {
    const auto diagonal = diagonals.col(j % diagonals.cols());
    if (beta == 0)
      Y.col(j) = diagonal * product.col(j).array();
    else
      Y.col(j) = diagonal * product.col(j).array() + beta * Y.col(j).array();
  }
}

void add_answer(double alpha, const ConstFieldRef& E, const ConstFieldRef& reflected, double beta,
                FieldRef Y) {
  if (beta == 0)
    Y = alpha * (E + reflected);
  else
    Y = alpha * (E + reflected) + beta * Y;
}

}  // namespace radiosity

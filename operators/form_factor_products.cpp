#include "operators/form_factor_products.hpp"

#include "kernels/products.hpp"

namespace radiosity {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Y = M X as a function that returns Y; M is square.
template <typename Multiply>
auto returning(const Multiply& multiply_with) {
  return [multiply_with](const MatrixXd& X) {
    MatrixXd Y(X.rows(), X.cols());
    multiply_with(X, Y);
    return Y;
  };
}

}  // namespace

MatrixProducts form_factor_products(const FormFactors& form_factors, FactorizationNorm norm) {
  const Index n = form_factors.patch_count();
  if (!form_factors.symmetric()) {
    const auto matrix = form_factors.unsymmetric;
    return {n, n, returning([matrix](const MatrixXd& X, MatrixXd& Y) { multiply(*matrix, X, Y); }),
            returning([matrix](const MatrixXd& X, MatrixXd& Y) { multiply_transposed(*matrix, X, Y); })};
  }
  const auto kernel = form_factors.kernel;
  if (norm == FactorizationNorm::area) {
    const auto symmetric = returning([kernel](const MatrixXd& X, MatrixXd& Y) { multiply(*kernel, X, Y); });
    return {n, n, symmetric, symmetric};
  }
  // F = A^{-1/2} K A^{1/2}.
  const VectorXd root = form_factors.mesh->area.cwiseSqrt();
  return {n, n, returning([kernel, root](const MatrixXd& X, MatrixXd& Y) {
            multiply(*kernel, root.asDiagonal() * X, Y);
            Y = root.cwiseInverse().asDiagonal() * Y;
          }),
          returning([kernel, root](const MatrixXd& X, MatrixXd& Y) {
            multiply(*kernel, root.cwiseInverse().asDiagonal() * X, Y);
            Y = root.asDiagonal() * Y;
          })};
}

}  // namespace radiosity

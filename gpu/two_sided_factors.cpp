#include "gpu/two_sided_factors.hpp"

namespace radiosity {
namespace {

template <typename Scalar>
Eigen::MatrixXd all_entries(const TallMatrix<Scalar>& matrix) {
  return Eigen::MatrixXd::NullaryExpr(matrix.rows(), matrix.columns(),
                                      [&](Index e, Index p) { return matrix(e, p); });
}

Eigen::MatrixXd all_entries(const Segments& segments) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(segments.rows(), segments.count());
  for (Index p = 0; p < segments.count(); ++p)
    for (auto k = static_cast<std::size_t>(segments.offsets()[static_cast<std::size_t>(p)]);
         k < static_cast<std::size_t>(segments.offsets()[static_cast<std::size_t>(p) + 1]); ++k) {
      const Index row = segments.order().empty() ? static_cast<Index>(k) : segments.order()[k];
      matrix(row, p) = segments.weights().empty() ? 1 : segments.weights()[k];
    }
  return matrix;
}

Eigen::MatrixXd side_by_side(const Eigen::MatrixXd& left, const Eigen::MatrixXd& right) {
  Eigen::MatrixXd both(left.rows(), left.cols() + right.cols());
  both << left, right;
  return both;
}

}  // namespace

template <typename Scalar>
TallMatrix<Scalar> full_left_factor(const TwoSidedOperator<Scalar>& kernel) {
  return TallMatrix<Scalar>(side_by_side(all_entries(kernel.factor()), all_entries(kernel.indicators())));
}

template <typename Scalar>
TallMatrix<Scalar> full_right_factor(const TwoSidedOperator<Scalar>& kernel) {
  return TallMatrix<Scalar>(side_by_side(all_entries(kernel.indicators()), all_entries(kernel.factor())));
}

template TallMatrix<double> full_left_factor(const TwoSidedOperator<double>& kernel);
template TallMatrix<float> full_left_factor(const TwoSidedOperator<float>& kernel);
template TallMatrix<double> full_right_factor(const TwoSidedOperator<double>& kernel);
template TallMatrix<float> full_right_factor(const TwoSidedOperator<float>& kernel);

}  // namespace radiosity

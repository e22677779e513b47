#include "factorizations/matrix_products.hpp"

#include "foundation/random.hpp"

#include <cmath>
#include <numbers>

namespace radiosity {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd unit_columns(Index rows, const std::vector<Index>& which) {
  MatrixXd units = MatrixXd::Zero(rows, static_cast<Index>(which.size()));
  for (Index j = 0; j < units.cols(); ++j) units(which[static_cast<std::size_t>(j)], j) = 1;
  return units;
}

}  // namespace

MatrixProducts MatrixProducts::of(const MatrixXd& matrix) {
  return {matrix.rows(), matrix.cols(), [&matrix](const MatrixXd& X) { return MatrixXd(matrix * X); },
          [&matrix](const MatrixXd& X) { return MatrixXd(matrix.transpose() * X); }};
}

MatrixXd columns_of(const MatrixProducts& A, const std::vector<Index>& which) {
  return A.apply(unit_columns(A.columns, which));
}

MatrixXd rows_of(const MatrixProducts& A, const std::vector<Index>& which) {
  return A.apply_transposed(unit_columns(A.rows, which)).transpose();
}

MatrixXd normal_numbers(Index rows, Index columns, std::uint64_t seed) {
  MatrixXd matrix(rows, columns);
  for (Index j = 0; j < columns; ++j) {
    RandomStream random(seed, static_cast<std::uint64_t>(j));
    for (Index i = 0; i < rows; ++i) {
      const double radius = std::sqrt(-2 * std::log(1 - random.uniform()));
      matrix(i, j) = radius * std::cos(2 * std::numbers::pi * random.uniform());
    }
  }
  return matrix;
}

}  // namespace radiosity

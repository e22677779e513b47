#include "kernels/absolute_sums.hpp"

#include "kernels/stored_number.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

/// Adds |entry| weight to a sum and notes signs.
struct Adder {
  AbsoluteSums result;
  const Eigen::VectorXd& weights;

  Adder(Index rows, const Eigen::VectorXd& column_weights) : weights(column_weights) {
    result.sums = Eigen::VectorXd::Zero(rows);
  }
  void add(Index row, Index column, double value) {
    result.sums[row] += std::fabs(value) * weights[column];
    result.non_negative = result.non_negative && value >= 0;
  }
};

template <typename Scalar>
void add_entries(const RowGroups<Scalar>& M, Adder& adder) {
  M.visit_entries(
      [&](Index row, Index column, Scalar value) { adder.add(row, column, static_cast<double>(value)); });
}

}  // namespace

template <typename Scalar>
AbsoluteSums absolute_sums(const SymmetricTiles<Scalar>& M, const Eigen::VectorXd& weights) {
  constexpr Index size = SymmetricTiles<Scalar>::tile_size;
  Adder adder(M.size(), weights);
  for (Index I = 0; I < M.tile_rows(); ++I)
    for (Index tile = M.row_begin(I); tile < M.row_begin(I + 1); ++tile) {
      const Index J = M.tile_column(tile);
      for (Index r = 0; r < std::min(size, M.size() - I * size); ++r)
        for (Index c = 0; c < std::min(size, M.size() - J * size); ++c) {
          const double value = M.scale() * to_double(M.tile_data(tile)[r * size + c]);
          adder.add(I * size + r, J * size + c, value);
          if (I != J) adder.add(J * size + c, I * size + r, value);
        }
    }
  return adder.result;
}

template <typename Scalar>
AbsoluteSums absolute_sums(const RowMajorMatrix<Scalar>& M, const Eigen::VectorXd& weights) {
  Adder adder(M.rows(), weights);
  for (Index i = 0; i < M.rows(); ++i)
    for (Index j = 0; j < M.cols(); ++j) adder.add(i, j, M(i, j));
  return adder.result;
}

template <typename Scalar>
AbsoluteSums absolute_sums(const RowGroups<Scalar>& M, const Eigen::VectorXd& weights) {
  Adder adder(M.rows(), weights);
  add_entries(M, adder);
  return adder.result;
}

template AbsoluteSums absolute_sums(const SymmetricTiles<double>&, const Eigen::VectorXd&);
template AbsoluteSums absolute_sums(const SymmetricTiles<float>&, const Eigen::VectorXd&);
template AbsoluteSums absolute_sums(const SymmetricTiles<Half>&, const Eigen::VectorXd&);
template AbsoluteSums absolute_sums(const RowMajorMatrix<double>&, const Eigen::VectorXd&);
template AbsoluteSums absolute_sums(const RowMajorMatrix<float>&, const Eigen::VectorXd&);
template AbsoluteSums absolute_sums(const RowMajorMatrix<Half>&, const Eigen::VectorXd&);
template AbsoluteSums absolute_sums(const RowGroups<double>&, const Eigen::VectorXd&);
template AbsoluteSums absolute_sums(const RowGroups<float>&, const Eigen::VectorXd&);

}  // namespace radiosity

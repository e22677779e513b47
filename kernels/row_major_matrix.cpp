#include "kernels/row_major_matrix.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "kernels/aligned_memory.hpp"
#include "kernels/stored_number.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace radiosity {

template <typename Scalar>
RowMajorMatrix<Scalar>::RowMajorMatrix(Index rows, Index cols) : rows_(rows), cols_(cols) {
  if (rows < 0 || cols < 0) fail<UsageError>("a matrix of {} x {} does not exist", rows, cols);
  // Whole vectors of 64 numbers, so that a product's inner loop has no remainder.
  stride_ = (cols + 63) / 64 * 64;
  entries_.reset(static_cast<Scalar*>(allocate_zeroed(entry_bytes())));
}

template <typename Scalar>
RowMajorMatrix<Scalar>::RowMajorMatrix(const Eigen::Ref<const Eigen::MatrixXd>& matrix)
    : RowMajorMatrix(matrix.rows(), matrix.cols()) {
  if (!matrix.allFinite()) fail("a matrix entry is not a finite number: it cannot be stored");
  if (matrix.size() > 0) scale_ = storage_scale<Scalar>(matrix.cwiseAbs().maxCoeff());
  parallel_for(
      static_cast<std::size_t>(rows_),
      [&](std::size_t index) {
        const auto i = static_cast<Index>(index);
        for (Index j = 0; j < cols_; ++j) row(i)[j] = round_to<Scalar>(matrix(i, j) / scale_);
      },
      16);
}

template <typename Scalar>
void RowMajorMatrix<Scalar>::Release::operator()(Scalar* entries) const {
  release_aligned(entries);
}

template <typename Scalar>
double RowMajorMatrix<Scalar>::operator()(Index i, Index j) const {
  return scale_ * to_double(row(i)[j]);
}

template <typename To>
RowMajorMatrix<To> convert(const RowMajorMatrix<double>& matrix) {
  const auto rows = static_cast<std::size_t>(matrix.rows());
  std::vector<double> largest(rows, 0.0);
  parallel_for(rows, [&](std::size_t i) {
    const double* entries = matrix.row(static_cast<Index>(i));
    for (Index j = 0; j < matrix.cols(); ++j) {
      if (!std::isfinite(entries[j])) fail("a matrix entry is not a finite number: it cannot be converted");
      largest[i] = std::max(largest[i], std::fabs(entries[j]));
    }
  });
  RowMajorMatrix<To> result(matrix.rows(), matrix.cols());
  const double scale = rows == 0 ? 1.0 : storage_scale<To>(*std::max_element(largest.begin(), largest.end()));
  result.set_scale(scale * matrix.scale());
  parallel_for(rows, [&](std::size_t i) {
    const double* from = matrix.row(static_cast<Index>(i));
    To* to = result.row(static_cast<Index>(i));
    for (Index j = 0; j < matrix.cols(); ++j) to[j] = round_to<To>(from[j] / scale);
  });
  return result;
}

template class RowMajorMatrix<double>;
template class RowMajorMatrix<float>;
template class RowMajorMatrix<Half>;

template RowMajorMatrix<double> convert(const RowMajorMatrix<double>&);
template RowMajorMatrix<float> convert(const RowMajorMatrix<double>&);
template RowMajorMatrix<Half> convert(const RowMajorMatrix<double>&);

}  // namespace radiosity

#include "kernels/tall_matrix.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "kernels/aligned_memory.hpp"
#include "kernels/stored_number.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

/// Panels that are about a megabyte: as little as is worth a thread where memory is filled.
Index panels_of_a_megabyte(Index columns) {
  return std::max<Index>(2048 / std::max<Index>(columns, 1), 1);
}

template <typename Scalar>
double tall_matrix_scale(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  if (!matrix.allFinite()) fail("a matrix entry is not a finite number: it cannot be stored");
  return matrix.size() == 0 ? 1.0 : storage_scale<Scalar>(matrix.cwiseAbs().maxCoeff());
}

}  // namespace

template <typename Scalar>
TallMatrix<Scalar>::TallMatrix(Index rows, Index columns, double scale)
    : rows_(rows), columns_(columns), scale_(scale) {
  if (rows < 0 || columns < 0) fail<UsageError>("a matrix of {} x {} does not exist", rows, columns);
  int exponent = 0;
  if (!(scale > 0) || !std::isfinite(scale) || std::frexp(scale, &exponent) != 0.5)
    fail<UsageError>("the scale {} of a matrix is not a power of two", scale);
  entries_.reset(static_cast<Scalar*>(allocate_aligned(entry_bytes())));
  // In parallel, because the system hands out pages as slowly as it clears them.
  parallel_for(
      static_cast<std::size_t>(panels()),
      [&](std::size_t b) {
        std::fill_n(entries_.get() + static_cast<Index>(b) * panel_rows * columns_, panel_rows * columns_,
                    Scalar{0});
      },
      static_cast<std::size_t>(panels_of_a_megabyte(columns)));
}

template <typename Scalar>
TallMatrix<Scalar>::TallMatrix(const Eigen::Ref<const Eigen::MatrixXd>& matrix)
    : TallMatrix(matrix.rows(), matrix.cols(), tall_matrix_scale<Scalar>(matrix)) {
  parallel_for(
      static_cast<std::size_t>(panels()),
      [&](std::size_t index) {
        const auto b = static_cast<Index>(index);
        fill_panel(b, matrix.middleRows(b * panel_rows, std::min(panel_rows, rows_ - b * panel_rows)));
      },
      static_cast<std::size_t>(panels_of_a_megabyte(columns_)));
}

template <typename Scalar>
TallMatrix<Scalar> TallMatrix<Scalar>::clone() const {
  TallMatrix copy(rows_, columns_, scale_);
  std::copy_n(entries_.get(), panels() * panel_rows * columns_, copy.entries_.get());
  return copy;
}

template <typename Scalar>
void TallMatrix<Scalar>::Release::operator()(Scalar* entries) const {
  release_aligned(entries);
}

template <typename Scalar>
double TallMatrix<Scalar>::operator()(Index e, Index p) const {
  return scale_ * to_double(*entry_address(e, p));
}

template <typename Scalar>
Scalar TallMatrix<Scalar>::stored(double entry) const {
  const auto number = static_cast<Scalar>(entry / scale_);
  if (!std::isfinite(number)) fail("a matrix entry of {} cannot be stored with a scale of {}", entry, scale_);
  return number;
}

template <typename Scalar>
void TallMatrix<Scalar>::set(Index e, Index p, double entry) {
  *entry_address(e, p) = stored(entry);
}

template <typename Scalar>
void TallMatrix<Scalar>::fill_panel(Index b, const Eigen::Ref<const Eigen::MatrixXd>& entries) {
  const Index first = b * panel_rows;
  const Index count = std::min(panel_rows, rows_ - first);
  if (b < 0 || count <= 0 || entries.rows() != count || entries.cols() != columns_)
    fail<UsageError>("{} x {} entries do not fill panel {} of a {} x {} matrix", entries.rows(),
                     entries.cols(), b, rows_, columns_);
  for (Index p = 0; p < columns_; ++p) {
    Scalar* column = entry_address(first, p);
    for (Index i = 0; i < count; ++i) column[i] = stored(entries(i, p));
  }
}

template class TallMatrix<double>;
template class TallMatrix<float>;

}  // namespace radiosity

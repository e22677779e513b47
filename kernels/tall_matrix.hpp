#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <memory>

namespace radiosity {

using Index = Eigen::Index;

/// An n x k matrix with many more rows than columns, such as a factor of a low-rank operator (document 004,
/// Section 2), in panels of 64 rows that are stored by columns: entry (e, p) is number 64 p + e % 64 of panel
/// e / 64. Panels lie one after the other, aligned to 64 bytes, so that products read memory as one stream
/// and only the last panel is padded, with zeros, whatever k is. The matrix is scale() times the stored
/// numbers. Scalar: double or float.
template <typename Scalar>
class TallMatrix {
 public:
  static constexpr Index panel_rows = 64;

  /// All zero. Entries are stored divided by `scale`, a power of two: float holds magnitudes from
  /// 2^-126 scale to 2^127 scale, and storage_scale<Scalar>(the largest) is right for every matrix.
  TallMatrix(Index rows, Index columns, double scale = 1);
  /// From a matrix in double precision, with the scale that RowMajorMatrix would choose.
  explicit TallMatrix(const Eigen::Ref<const Eigen::MatrixXd>& matrix);

  /// The same numbers once more.
  TallMatrix clone() const;

  Index rows() const { return rows_; }
  Index columns() const { return columns_; }
  double scale() const { return scale_; }
  double operator()(Index e, Index p) const;

  Index panels() const { return (rows_ + panel_rows - 1) / panel_rows; }
  /// The 64 x columns() numbers of rows 64 b ... 64 b + 63.
  const Scalar* panel(Index b) const { return entries_.get() + b * panel_rows * columns_; }

  /// Different entries may be set from different threads at once. Throws Error where the entry is not finite
  /// or too large for the scale.
  void set(Index e, Index p, double entry);
  /// Sets the rows of panel b to `entries`, min(64, rows() - 64 b) x columns(). Different panels may be
  /// filled from different threads at once. Throws as set(), and UsageError where shapes do not fit.
  void fill_panel(Index b, const Eigen::Ref<const Eigen::MatrixXd>& entries);

  std::size_t entry_bytes() const {
    return static_cast<std::size_t>(panels() * panel_rows * columns_) * sizeof(Scalar);
  }

 private:
  struct Release {
    void operator()(Scalar* entries) const;
  };

  Scalar* entry_address(Index e, Index p) const {
    return entries_.get() + (e / panel_rows * columns_ + p) * panel_rows + e % panel_rows;
  }
  Scalar stored(double entry) const;

  Index rows_;
  Index columns_;
  double scale_;
  std::unique_ptr<Scalar[], Release> entries_;
};

extern template class TallMatrix<double>;
extern template class TallMatrix<float>;

}  // namespace radiosity

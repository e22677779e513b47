#pragma once

#include "kernels/half.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <memory>

namespace radiosity {

using Index = Eigen::Index;

/// A full m x n matrix stored by rows, each row padded with zeros to a multiple of 64 numbers and aligned to
/// 64 bytes. The matrix is scale() times the stored numbers.
template <typename Scalar>
class RowMajorMatrix {
 public:
  RowMajorMatrix(Index rows, Index cols);
  /// From a matrix in double precision; Half chooses its scale as SymmetricTiles does.
  explicit RowMajorMatrix(const Eigen::Ref<const Eigen::MatrixXd>& matrix);

  Index rows() const { return rows_; }
  Index cols() const { return cols_; }
  Index stride() const { return stride_; }
  double scale() const { return scale_; }
  void set_scale(double scale) { scale_ = scale; }
  Scalar* row(Index i) { return entries_.get() + i * stride_; }
  const Scalar* row(Index i) const { return entries_.get() + i * stride_; }
  double operator()(Index i, Index j) const;
  std::size_t entry_bytes() const { return static_cast<std::size_t>(rows_ * stride_) * sizeof(Scalar); }

 private:
  struct Release {
    void operator()(Scalar* entries) const;
  };

  Index rows_;
  Index cols_;
  Index stride_;
  double scale_ = 1;
  std::unique_ptr<Scalar[], Release> entries_;
};

/// The same matrix in another precision, as convert() of SymmetricTiles.
template <typename To>
RowMajorMatrix<To> convert(const RowMajorMatrix<double>& matrix);

extern template class RowMajorMatrix<double>;
extern template class RowMajorMatrix<float>;
extern template class RowMajorMatrix<Half>;

}  // namespace radiosity

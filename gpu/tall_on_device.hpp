#pragma once

#include "gpu/shader_family.hpp"
#include "gpu/stored_rows.hpp"
#include "kernels/tall_matrix.hpp"

#include <cstdint>
#include <memory>

namespace radiosity {

/// A factor of n x k on the device, in double or float32, in panels of 64 rows as TallMatrix has them: a
/// copy, number for number, in which the 64 invocations of a work group find a column of a panel side by
/// side. Split by panels where it takes more than a storage block. Fields of n rows lie as FieldBuffers says,
/// coefficients of k alike, both in the factor's precision.
class TallOnDevice {
 public:
  static constexpr unsigned partial_binding = 3;

  /// `strategy`: group for a work group a panel or a column of it, invocation for some rows or columns each;
  /// in double precision, which has no texels, it is always group. Row e of products goes to row order[e] of
  /// Y, in 32 bits each; without that list to row e. Throws Error where a panel does not fit into a storage
  /// block, or the factor not into the device.
  template <typename Scalar>
  TallOnDevice(std::shared_ptr<GlDevice> device, const TallMatrix<Scalar>& matrix, RowStrategy strategy,
               std::shared_ptr<const GlBuffer> order = nullptr);

  Index rows() const { return rows_; }
  Index columns() const { return columns_; }
  double scale() const { return scale_; }
  bool in_double() const { return in_double_; }
  std::size_t bytes() const { return panels_.bytes(); }

  /// Y = M C: coefficients are bound as X, the field as Y, both for FieldBuffers' bindings. Without scale().
  void multiply(Index columns) const;

  /// Sums of M' X, X bound as FieldBuffers' X, over chunks() of rows, which are bound to partial_binding: sum
  /// p of column c and chunk i is number (i columns + c) padded(k) + p. Without scale().
  void multiply_transposed(Index columns) const;
  Index chunks() const;

 private:
  void bind_vectors() const;
  void bind_panels(const StoredRows::Part& part) const;

  std::shared_ptr<GlDevice> device_;
  Index rows_;
  Index columns_;
  double scale_;
  bool in_double_;
  StoredRows panels_;
  std::shared_ptr<const GlBuffer> order_;
  bool by_texels_;
  Index columns_of_group_;  ///< of M' X
  ShaderFamily product_;
  ShaderFamily transposed_;
};

extern template TallOnDevice::TallOnDevice(std::shared_ptr<GlDevice>, const TallMatrix<double>&, RowStrategy,
                                           std::shared_ptr<const GlBuffer>);
extern template TallOnDevice::TallOnDevice(std::shared_ptr<GlDevice>, const TallMatrix<float>&, RowStrategy,
                                           std::shared_ptr<const GlBuffer>);

}  // namespace radiosity

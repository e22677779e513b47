#pragma once

#include "gpu/device_matrix.hpp"
#include "gpu/shader_family.hpp"
#include "kernels/csr_matrix.hpp"

#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

namespace radiosity {

/// A sparse matrix by compressed rows on the device, in double or float32, with columns in 16 bits up to
/// 65536 of them, split by rows where its entries take more than a storage block. Where neighbouring rows
/// have entries in the same columns, they are by fours (row_fours.hpp).
template <typename Scalar>
class CsrOnDevice final : public DeviceMatrix {
 public:
  /// Copies the matrix. Throws Error where a row does not fit into a storage block, or the matrix not into
  /// the device.
  CsrOnDevice(std::shared_ptr<GlDevice> device, const CsrMatrix<Scalar>& matrix, RowStrategy strategy);

  ByteCount bytes() const override;
  double scale() const override { return 1; }
  bool in_double() const override { return std::is_same_v<Scalar, double>; }

  /// Y = M X and Y += M X, both bound as FieldBuffers says, for the columns first, first + step, ... below
  /// `columns`: for matrices that are a part of another.
  void dispatch_product(Index first, Index step, Index columns) const;
  void dispatch_sum(Index first, Index step, Index columns) const;

  /// Over how many storage blocks it is split.
  std::size_t blocks() const { return blocks_.size(); }

 protected:
  void dispatch(Index columns) const override;

 private:
  struct Block {
    Index first_row;  ///< in fours of them where rows are together, as the next
    Index rows;
    GlBuffer values;
    GlBuffer columns;
    GlBuffer row_begin;  ///< rows + 1 numbers, from the block's first entry on
  };
  CsrOnDevice(std::shared_ptr<GlDevice> device, const CsrMatrix<Scalar>& matrix,
              const std::optional<CsrMatrix<Scalar>>& fours, RowStrategy strategy);
  void upload_block(const CsrMatrix<Scalar>& matrix, Index first_row, Index end_row);
  GlBuffer upload_columns(const std::int32_t* columns, std::size_t count) const;
  /// Textures have no texels in double precision.
  bool by_texels() const { return strategy_ == RowStrategy::invocation && !in_double(); }
  void bind(const Block& block) const;
  /// For `count` columns first, first + step, ...
  void dispatch_rows(const ShaderFamily& shaders, Index first, Index step, Index count) const;

  RowStrategy strategy_;
  Index together_;  ///< 4 by fours of rows, else 1
  bool narrow_;     ///< columns in 16 bits
  ShaderFamily product_;
  ShaderFamily sum_;  ///< Y += M X
  std::vector<Block> blocks_;
};

extern template class CsrOnDevice<double>;
extern template class CsrOnDevice<float>;

}  // namespace radiosity

#pragma once

#include "gpu/device_matrix.hpp"
#include "kernels/csr_matrix.hpp"

#include <vector>

namespace radiosity {

/// A sparse matrix by compressed rows on the device, in float32, split by rows where its entries take more
/// than a storage block.
class CsrOnDevice final : public DeviceMatrix {
 public:
  /// Copies the matrix. Throws Error where a row does not fit into a storage block, or the matrix not into
  /// the device.
  CsrOnDevice(std::shared_ptr<GlDevice> device, const CsrMatrix<float>& matrix, RowStrategy strategy);

  ByteCount bytes() const override;
  /// Over how many storage blocks it is split.
  std::size_t blocks() const { return blocks_.size(); }

 protected:
  void dispatch(Index columns) const override;
  double scale() const override { return 1; }

 private:
  struct Block {
    Index first_row;
    Index rows;
    GlBuffer values;
    GlBuffer columns;
    GlBuffer row_begin;  ///< rows + 1 numbers, from the block's first entry on
  };
  void upload_block(const CsrMatrix<float>& matrix, Index first_row, Index end_row);
  void dispatch_block(const Block& block, Index first_column, Index columns) const;

  RowStrategy strategy_;
  std::vector<Block> blocks_;
};

}  // namespace radiosity

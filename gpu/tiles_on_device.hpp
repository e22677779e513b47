#pragma once

#include "gpu/shader_family.hpp"
#include "gpu/stored_rows.hpp"
#include "gpu/texels_on_device.hpp"
#include "kernels/quantized_tiles.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace radiosity {

/// Matrices in quantized tiles on the device, one a channel, in any of their formats: records as they are,
/// which a shader decodes to the numbers that the CPU's decoders give. Of a symmetric matrix the upper
/// triangle alone is stored, and each of its tiles is read twice, the second time for what its transpose
/// gives other rows: no two invocations write the same number. What is kept apart stands in place of an
/// entry; it is a sparse matrix of the differences here.
class TilesOnDevice final : public TexelsOnDevice {
 public:
  /// One element a channel, all of one format. Throws Error where the matrices do not fit into the device.
  TilesOnDevice(const std::shared_ptr<GlDevice>& device, std::span<const QuantizedTiles> channels,
                RowStrategy strategy);

 protected:
  void dispatch_texels(Index columns) const override;
  bool has_texels(Index channel) const override;
  std::size_t texel_bytes() const override;
  std::size_t index_bytes() const override;

 private:
  /// Tiles in one storage block. Place k of tile row I, row_begin[I] <= k < row_begin[I + 1], is a tile of
  /// those and twice its column, plus 1 where it is transposed.
  struct Part {
    GlBuffer places;
    GlBuffer row_begin;
  };
  struct Channel {
    std::uint32_t scale_bits;  ///< of float: its scale as a part of scale()
    StoredRows records;        ///< a row a tile
    std::vector<Part> parts;   ///< of the records
  };
  Channel upload_channel(const QuantizedTiles& tiles) const;
  Part upload_places(const TileDirectory& directory, bool whole_diagonal, Index first_tile,
                     Index end_tile) const;
  void dispatch_part(Index channel, std::size_t part, Index columns) const;

  TileFormat format_;
  Index tile_rows_;
  ShaderFamily shaders_;
  std::vector<Channel> channels_;
};

}  // namespace radiosity

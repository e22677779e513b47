#include "gpu/bc4_on_device.hpp"

#include "kernels/stored_number.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <epoxy/gl.h>
#include <utility>

namespace radiosity {
namespace {

constexpr unsigned bc4_blocks_binding = 0;
constexpr int invocations_of_bc4_group = 64;
constexpr Index block_rows_of_tile = QuantizedTiles::tile_size / 4;

int lanes_of_blocks(RowStrategy strategy) {
  return strategy == RowStrategy::group ? invocations_of_bc4_group : 1;
}

/// What the exact entries of a matrix are more than the texels in their places, divided by `scale`.
CsrMatrix<float> differences_from_texels(const QuantizedTiles& tiles, double scale) {
  constexpr Index size = QuantizedTiles::tile_size;
  const TileDirectory& directory = tiles.directory();
  CsrMatrix<float> matrix;
  matrix.cols = tiles.size();
  std::array<float, QuantizedTiles::tile_entries> texels;
  for (Index I = 0; I < directory.tile_rows(); ++I) {
    std::array<std::vector<std::pair<std::int32_t, float>>, size> rows;
    for (Index tile = directory.row_begin(I); tile < directory.row_begin(I + 1); ++tile) {
      tiles.decode_record(tile, texels.data());
      for (std::size_t k = tiles.exact_begin(tile); k < tiles.exact_begin(tile + 1); ++k) {
        const std::size_t position = tiles.exact_position()[k];
        const double difference =
            static_cast<double>(tiles.exact_value()[k]) - static_cast<double>(texels[position]);
        rows[position / size].emplace_back(static_cast<std::int32_t>(size * directory.tile_column(tile) +
                                                                     static_cast<Index>(position % size)),
                                           static_cast<float>(tiles.scale() * difference / scale));
      }
    }
    for (Index r = 0; r < std::min(size, tiles.size() - I * size); ++r) {
      for (const auto& [column, value] : rows[static_cast<std::size_t>(r)]) {
        matrix.column.push_back(column);
        matrix.value.push_back(value);
      }
      matrix.row_begin.push_back(static_cast<std::int64_t>(matrix.value.size()));
    }
  }
  return matrix;
}

double largest_of_channels(const std::vector<QuantizedTiles>& channels) {
  double largest = 0;
  for (const QuantizedTiles& tiles : channels) {
    double exact = 1;  // texels are parts of scale()
    for (const float value : tiles.exact_value()) exact = std::max(exact, static_cast<double>(value));
    largest = std::max(largest, tiles.scale() * exact);
  }
  return largest;
}

}  // namespace

bool Bc4OnDevice::takes(const QuantizedTiles& tiles) {
  const TileDirectory& directory = tiles.directory();
  return tiles.format().code == EntryCode::bc4 && !directory.symmetric() &&
         directory.tile_count() == directory.tile_rows() * directory.tile_rows();
}

Bc4OnDevice::Bc4OnDevice(std::shared_ptr<GlDevice> device_of_tiles,
                         const std::vector<QuantizedTiles>& channels, RowStrategy strategy)
    : DeviceMatrix(device_of_tiles, channels.front().size(), channels.front().size()),
      strategy_(strategy),
      scale_(storage_scale<float>(largest_of_channels(channels))),
      curve_(channels.front().format().curve),
      shaders_("bc4_product.comp", {{"LOGARITHMIC", curve_.logarithmic ? 1 : 0},
                                    {"INVOCATIONS", invocations_of_bc4_group},
                                    {"LANES", lanes_of_blocks(strategy)}}) {
  const CurrentContext current(*device().context());
  for (const QuantizedTiles& tiles : channels)
    channels_.push_back(
        {std::bit_cast<std::uint32_t>(static_cast<float>(tiles.scale() / scale_)), upload_blocks(tiles),
         std::make_unique<CsrOnDevice>(device_of_tiles, differences_from_texels(tiles, scale_), strategy)});
}

StoredRows Bc4OnDevice::upload_blocks(const QuantizedTiles& tiles) const {
  const Index tile_rows = tiles.directory().tile_rows();
  return {
      device().context(),
      {.rows = tile_rows, .row_bytes = tile_rows * tiles.record_bytes(), .subject = "a row of tiles takes"},
      [&](Index row) { return tiles.record(row * tile_rows); }};
}

ByteCount Bc4OnDevice::bytes() const {
  ByteCount bytes{{{"texels", 0}, {"exact", 0}, {"indices", 0}}};
  for (const Channel& channel : channels_) {
    bytes.parts[0].second += channel.tile_rows.bytes();
    const ByteCount exact = channel.exact->bytes();
    for (std::size_t part = 0; part < exact.parts.size(); ++part)
      bytes.parts[part + 1].second += exact.parts[part].second;
  }
  return bytes;
}

void Bc4OnDevice::dispatch(Index columns) const {
  const auto step = static_cast<Index>(channels_.size());
  for (Index channel = 0; channel < step; ++channel)
    for (const StoredRows::Part& part : channels_[static_cast<std::size_t>(channel)].tile_rows.parts())
      dispatch_part(channels_[static_cast<std::size_t>(channel)], part, channel, step, columns);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  for (Index channel = 0; channel < step; ++channel)
    channels_[static_cast<std::size_t>(channel)].exact->dispatch_sum(channel, step, columns);
}

void Bc4OnDevice::dispatch_part(const Channel& channel, const StoredRows::Part& part, Index first_column,
                                Index step, Index columns) const {
  part.buffer.bind(bc4_blocks_binding);
  const Index block_rows = part.rows * block_rows_of_tile;
  const Index rows_together = invocations_of_bc4_group / lanes_of_blocks(strategy_);
  const Index count = (columns - first_column + step - 1) / step;
  shaders_.for_columns(device(), count, [&](const GlProgram& program, Index column) {
    program.set("tile_columns", FieldBuffers::padded(cols()) / QuantizedTiles::tile_size);
    program.set("first_row", part.first_row * QuantizedTiles::tile_size);
    program.set("part_block_rows", block_rows);
    program.set("y_stride", FieldBuffers::padded(rows()));
    program.set("first_column", first_column + step * column);
    program.set("column_step", step);
    program.set("scale_bits", channel.scale_bits);
    program.set("base_bits", std::bit_cast<std::uint32_t>(curve_.base));
    program.set("slope_bits", std::bit_cast<std::uint32_t>(curve_.slope));
    program.dispatch((block_rows + rows_together - 1) / rows_together);
  });
}

}  // namespace radiosity

#include "gpu/tiles_on_device.hpp"

#include "gpu/tile_differences.hpp"

#include <algorithm>
#include <bit>
#include <epoxy/gl.h>
#include <utility>

namespace radiosity {
namespace {

constexpr unsigned records_binding = 0;
constexpr unsigned tile_places_binding = 3;
constexpr unsigned tile_row_begin_binding = 4;
constexpr int invocations_of_tile_group = 64;
constexpr Index block_rows_of_tile = QuantizedTiles::tile_size / 4;

/// Invocations that share four rows.
int lanes_of_tiles(RowStrategy strategy) {
  return strategy == RowStrategy::group ? invocations_of_tile_group : 1;
}

/// As shaders/tile_codes.glsl numbers them.
int code_number(const TileFormat& format) {
  switch (format.code) {
    case EntryCode::steps:
      return 0;
    case EntryCode::curve:
      return format.bits == 8 ? 1 : 2;
    case EntryCode::bc4:
      return 3;
    case EntryCode::half:
      return 4;
    case EntryCode::brain:
      break;
  }
  return 5;
}

ShaderFamily shaders_of_tiles(const QuantizedTiles& tiles, RowStrategy strategy) {
  const TileFormat& format = tiles.format();
  return {"tile_product.comp",
          {{"CODE", code_number(format)},
           {"BITS", format.bits},
           {"BLOCK", format.block},
           {"LOGARITHMIC", format.curve.logarithmic ? 1 : 0},
           {"SYMMETRIC", tiles.directory().symmetric() ? 1 : 0},
           {"INVOCATIONS", invocations_of_tile_group},
           {"LANES", lanes_of_tiles(strategy)}}};
}

GlBuffer buffer_of_numbers(const std::shared_ptr<const GlContext>& context,
                           const std::vector<std::uint32_t>& numbers) {
  const std::size_t bytes = numbers.size() * sizeof(std::uint32_t);
  GlBuffer buffer(context, std::max(bytes, 2 * sizeof(std::uint32_t)));
  if (bytes > 0) buffer.write(0, bytes, numbers.data());
  return buffer;
}

}  // namespace

TilesOnDevice::TilesOnDevice(const std::shared_ptr<GlDevice>& device_of_tiles,
                             std::span<const QuantizedTiles> channels, RowStrategy strategy)
    : TexelsOnDevice(device_of_tiles, channels.front().size(), channels.front().size(),
                     differences_from_texels(channels), strategy),
      format_(channels.front().format()),
      tile_rows_(channels.front().directory().tile_rows()),
      shaders_(shaders_of_tiles(channels.front(), strategy)) {
  const CurrentContext current(*device().context());
  for (const QuantizedTiles& tiles : channels) channels_.push_back(upload_channel(tiles));
}

TilesOnDevice::Channel TilesOnDevice::upload_channel(const QuantizedTiles& tiles) const {
  const Index count = tiles.record_bytes() == 0 ? 0 : tiles.directory().tile_count();
  Channel channel{
      std::bit_cast<std::uint32_t>(static_cast<float>(tiles.scale() / scale())),
      {device().context(),
       {.rows = count, .row_bytes = tiles.record_bytes(), .subject = "a tile of the matrix takes"},
       [&](Index tile) { return tiles.record(tile); }},
      {}};
  for (const StoredRows::Part& part : channel.records.parts())
    channel.parts.push_back(
        upload_places(tiles.directory(), tiles.whole_diagonal(), part.first_row, part.first_row + part.rows));
  return channel;
}

TilesOnDevice::Part TilesOnDevice::upload_places(const TileDirectory& directory, bool whole_diagonal,
                                                 Index first_tile, Index end_tile) const {
  std::vector<std::vector<std::uint32_t>> rows(static_cast<std::size_t>(tile_rows_));
  const auto add = [&](Index row, Index tile, Index column, bool transposed) {
    rows[static_cast<std::size_t>(row)].push_back(static_cast<std::uint32_t>(tile - first_tile));
    rows[static_cast<std::size_t>(row)].push_back(
        static_cast<std::uint32_t>(2 * column + (transposed ? 1 : 0)));
  };
  for (Index I = 0; I < tile_rows_; ++I)
    for (Index tile = std::max(first_tile, directory.row_begin(I));
         tile < std::min(end_tile, directory.row_begin(I + 1)); ++tile) {
      const Index J = directory.tile_column(tile);
      add(I, tile, J, false);
      if (directory.symmetric() && (I != J || !whole_diagonal)) add(J, tile, I, true);
    }
  std::vector<std::uint32_t> places;
  std::vector<std::uint32_t> row_begin = {0};
  for (const std::vector<std::uint32_t>& row : rows) {
    places.insert(places.end(), row.begin(), row.end());
    row_begin.push_back(static_cast<std::uint32_t>(places.size() / 2));
  }
  const auto& context = device().context();
  return {buffer_of_numbers(context, places), buffer_of_numbers(context, row_begin)};
}

bool TilesOnDevice::has_texels(Index channel) const {
  return !channels_[static_cast<std::size_t>(channel)].parts.empty();
}

std::size_t TilesOnDevice::texel_bytes() const {
  std::size_t bytes = 0;
  for (const Channel& channel : channels_) bytes += channel.records.bytes();
  return bytes;
}

std::size_t TilesOnDevice::index_bytes() const {
  std::size_t bytes = 0;
  for (const Channel& channel : channels_)
    for (const Part& part : channel.parts) bytes += part.places.bytes() + part.row_begin.bytes();
  return bytes;
}

void TilesOnDevice::dispatch_texels(Index columns) const {
  std::size_t most = 0;
  for (const Channel& channel : channels_) most = std::max(most, channel.parts.size());
  for (std::size_t part = 0; part < most; ++part) {
    if (part > 0) glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);  // it adds to what the one before wrote
    for (Index channel = 0; channel < channels(); ++channel)
      if (part < channels_[static_cast<std::size_t>(channel)].parts.size())
        dispatch_part(channel, part, columns);
  }
}

void TilesOnDevice::dispatch_part(Index channel, std::size_t part, Index columns) const {
  const Channel& own = channels_[static_cast<std::size_t>(channel)];
  own.records.parts()[part].buffer.bind(records_binding);
  own.parts[part].places.bind(tile_places_binding);
  own.parts[part].row_begin.bind(tile_row_begin_binding);
  const Index block_rows = tile_rows_ * block_rows_of_tile;
  const Index rows_together = invocations_of_tile_group / lanes_of_tiles(strategy());
  shaders_.for_columns(device(), columns_of(channel, columns), [&](const GlProgram& program, Index column) {
    program.set("tile_rows", tile_rows_);
    program.set("adds", part > 0 ? 1 : 0);
    program.set("first_column", channel + channels() * column);
    program.set("column_step", channels());
    program.set("scale_bits", own.scale_bits);
    program.set("base_bits", std::bit_cast<std::uint32_t>(format_.curve.base));
    program.set("slope_bits", std::bit_cast<std::uint32_t>(format_.curve.slope));
    program.dispatch((block_rows + rows_together - 1) / rows_together);
  });
}

}  // namespace radiosity

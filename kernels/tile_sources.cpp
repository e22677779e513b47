#include "kernels/tile_sources.hpp"

#include <algorithm>
#include <cstdint>

namespace radiosity {

QuantizedTileSource::QuantizedTileSource(const QuantizedTiles& tiles, InstructionSet instructions)
    : K_(tiles),
      decoder_(tile_decoder(instructions, tiles.format())),
      products_(tile_products<float>(instructions)) {
  if (K_.format().code == EntryCode::bc4) block_products_ = bc4_products(instructions, K_.format().curve);
  if (K_.format().code == EntryCode::half) half_products_ = tile_products<Half>(instructions);
}

bool QuantizedTileSource::in_registers(Index columns) const {
  return columns <= TileProducts<Entry>::most_columns &&
         (block_products_.both[0] != nullptr || half_products_.both[0] != nullptr);
}

const float* QuantizedTileSource::read(Index tile, Index columns, Entry* panel) const {
  const std::size_t end = K_.exact_begin(tile + 1);
  if (in_registers(columns) && K_.exact_begin(tile) == end) return nullptr;
  if (decoder_ == nullptr)
    std::fill(panel, panel + panel_entries, 0.0F);
  else
    decoder_(K_.record(tile), K_.record(tile) + tile_bytes_ahead, K_.format().curve, panel);
  const std::uint16_t* position = K_.exact_position().data();
  const float* value = K_.exact_value().data();
  for (std::size_t k = K_.exact_begin(tile); k < end; ++k) panel[position[k]] = value[k];
  return panel;
}

template <typename Stored>
void QuantizedTileSource::multiply_record(const TileProducts<Stored>& products, Index tile, TileSums sums,
                                          Index columns, const TileTask<Entry>& task) const {
  TileTask<Stored> stored(task);
  stored.entries = reinterpret_cast<const Stored*>(K_.record(tile));
  stored.prefetch = reinterpret_cast<const char*>(K_.record(tile) + tile_bytes_ahead);
  stored.curve = &K_.format().curve;
  product_of(products, sums, columns)(stored);
}

void QuantizedTileSource::multiply(Index tile, TileSums sums, Index columns, bool,
                                   const TileTask<Entry>& task) const {
  if (task.entries != nullptr)
    product_of(products_, sums, columns)(task);
  else if (K_.format().code == EntryCode::half)
    multiply_record(half_products_, tile, sums, columns, task);
  else
    multiply_record(block_products_, tile, sums, columns, task);
}

}  // namespace radiosity

#include "compression/half_kernel.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {

HalfKernel::HalfKernel(const SymmetricTiles<double>& K) : K_(K) {
  const TileDirectory& directory = K.directory();
  row_of_tile_.resize(static_cast<std::size_t>(directory.tile_count()));
  for (Index I = 0; I < directory.tile_rows(); ++I)
    for (Index tile = directory.row_begin(I); tile < directory.row_begin(I + 1); ++tile)
      row_of_tile_[static_cast<std::size_t>(tile)] = I;
  std::vector<double> largest(row_of_tile_.size());
  parallel_for(
      largest.size(),
      [&](std::size_t tile) {
        const double* entries = K.tile_data(static_cast<Index>(tile));
        for (std::size_t k = 0; k < tile_entries; ++k) {
          if (!(entries[k] >= 0 && std::isfinite(entries[k])))
            fail("a kernel with the entry {} cannot be compressed: entries must be 0 or positive",
                 entries[k]);
          largest[tile] = std::max(largest[tile], entries[k]);
        }
      },
      16);
  for (const double value : largest) largest_ = std::max(largest_, value);
}

std::size_t HalfKernel::share_of_entries(double fraction) const {
  if (!(fraction >= 0 && fraction <= 1))
    fail<UsageError>("a fraction of {} of the entries cannot be kept: choose 0 to 1", fraction);
  const auto n = static_cast<double>(K_.size());
  return static_cast<std::size_t>(fraction * n * (n + 1) / 2);
}

HalfKernel::Tile HalfKernel::tile(std::size_t number, double scale) const {
  Tile entries;
  const double* stored = K_.tile_data(static_cast<Index>(number));
  const double factor = K_.scale() / scale;
  for (std::size_t k = 0; k < entries.size(); ++k) entries[k] = stored[k] * factor;
  if (tile_row(number) == tile_column(number))
    for (std::size_t r = 0; r < tile_size; ++r) {
      std::fill_n(entries.begin() + static_cast<std::ptrdiff_t>(r * tile_size), r, 0.0);
      entries[r * tile_size + r] /= 2;
    }
  return entries;
}

QuantizedTiles::ExactEntries HalfKernel::marked_entries(const Tile& tile, const Marks& marks) {
  QuantizedTiles::ExactEntries entries;
  entries.position.reserve(marks.count());
  entries.value.reserve(marks.count());
  for (std::size_t k = 0; k < tile.size(); ++k)
    if (marks[k]) {
      entries.position.push_back(static_cast<std::uint16_t>(k));
      entries.value.push_back(static_cast<float>(tile[k]));
    }
  return entries;
}

}  // namespace radiosity

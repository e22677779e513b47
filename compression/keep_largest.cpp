#include "compression/keep_largest.hpp"

#include "compression/half_kernel.hpp"
#include "compression/largest_scores.hpp"
#include "foundation/parallel.hpp"
#include "kernels/stored_number.hpp"

#include <utility>

namespace radiosity {
namespace {

/// Calls visit(position, value) for the upper half of a tile, with the diagonal whole.
template <typename Visit>
void visit_entries(const HalfKernel& kernel, std::size_t number, const HalfKernel::Tile& tile,
                   const Visit& visit) {
  const bool diagonal = kernel.tile_row(number) == kernel.tile_column(number);
  for (std::size_t r = 0; r < HalfKernel::tile_size; ++r)
    for (std::size_t c = diagonal ? r : 0; c < HalfKernel::tile_size; ++c) {
      const std::size_t k = r * HalfKernel::tile_size + c;
      visit(k, static_cast<float>(diagonal && r == c ? 2 * tile[k] : tile[k]));
    }
}

}  // namespace

QuantizedTiles keep_largest(const SymmetricTiles<double>& K, double fraction) {
  const HalfKernel kernel(K);
  const double scale = storage_scale<float>(kernel.largest());
  std::vector<std::vector<float>> values(kernel.tile_count());
  parallel_for(kernel.tile_count(), [&](std::size_t number) {
    visit_entries(kernel, number, kernel.tile(number, scale),
                  [&](std::size_t, float value) { values[number].push_back(value); });
  });
  const std::vector<ScoreCut> cuts = cut_to_largest(values, kernel.share_of_entries(fraction));
  std::vector<QuantizedTiles::ExactEntries> kept(kernel.tile_count());
  parallel_for(kernel.tile_count(), [&](std::size_t number) {
    const HalfKernel::Tile tile = kernel.tile(number, scale);
    ScoreCut cut = cuts[number];
    HalfKernel::Marks marks;
    visit_entries(kernel, number, tile,
                  [&](std::size_t position, float value) { marks.set(position, cut.takes(value)); });
    kept[number] = HalfKernel::marked_entries(tile, marks);
  });
  const auto any_kept = [&](Index I, Index J) {
    const Index tile = K.find_tile(I, J);
    return tile >= 0 && !kept[static_cast<std::size_t>(tile)].value.empty();
  };
  QuantizedTiles result(TileDirectory(K.size(), any_kept), 0, 64);
  result.set_scale(scale);
  std::erase_if(kept, [](const QuantizedTiles::ExactEntries& entries) { return entries.value.empty(); });
  result.set_exact(kept);
  return result;
}

}  // namespace radiosity

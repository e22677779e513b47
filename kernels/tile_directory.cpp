#include "kernels/tile_directory.hpp"

#include "foundation/error.hpp"

#include <algorithm>

namespace radiosity {

TileDirectory::TileDirectory(Index size, const std::function<bool(Index, Index)>& present)
    : TileDirectory(size, true, present) {}

TileDirectory TileDirectory::full(Index size) {
  return {size, false, [](Index, Index) { return true; }};
}

TileDirectory::TileDirectory(Index size, bool symmetric, const std::function<bool(Index, Index)>& present)
    : size_(size), symmetric_(symmetric) {
  if (size < 0) fail<UsageError>("a kernel of size {} does not exist", size);
  row_begin_.push_back(0);
  for (Index I = 0; I < tile_rows(); ++I) {
    for (Index J = symmetric ? I : 0; J < tile_rows(); ++J)
      if (present(I, J)) columns_.push_back(static_cast<std::int32_t>(J));
    row_begin_.push_back(tile_count());
  }
}

Index TileDirectory::find_tile(Index tile_row, Index tile_column) const {
  const auto begin = columns_.begin() + row_begin(tile_row);
  const auto end = columns_.begin() + row_begin(tile_row + 1);
  const auto found = std::lower_bound(begin, end, static_cast<std::int32_t>(tile_column));
  return found != end && *found == tile_column ? found - columns_.begin() : -1;
}

std::size_t TileDirectory::bytes() const {
  return row_begin_.size() * sizeof(Index) + columns_.size() * sizeof(std::int32_t);
}

}  // namespace radiosity

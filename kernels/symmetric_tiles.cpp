#include "kernels/symmetric_tiles.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "kernels/aligned_memory.hpp"
#include "kernels/stored_number.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace radiosity {
namespace {

/// Largest |stored number|; throws Error for NaN and infinity.
template <typename Scalar>
double largest_stored(const SymmetricTiles<Scalar>& tiles) {
  std::vector<double> largest(static_cast<std::size_t>(tiles.tile_count()), 0.0);
  parallel_for(
      largest.size(),
      [&](std::size_t tile) {
        const Scalar* entries = tiles.tile_data(static_cast<Index>(tile));
        for (Index k = 0; k < SymmetricTiles<Scalar>::tile_entries; ++k) {
          const double magnitude = std::fabs(to_double(entries[k]));
          if (!std::isfinite(magnitude))
            fail("a kernel entry is not a finite number: it cannot be converted");
          largest[tile] = std::max(largest[tile], magnitude);
        }
      },
      16);
  return largest.empty() ? 0.0 : *std::max_element(largest.begin(), largest.end());
}

}  // namespace

template <typename Scalar>
SymmetricTiles<Scalar>::SymmetricTiles(TileDirectory directory) : directory_(std::move(directory)) {
  entries_.reset(static_cast<Scalar*>(allocate_zeroed(entry_bytes())));
}

template <typename Scalar>
void SymmetricTiles<Scalar>::Release::operator()(Scalar* entries) const {
  release_aligned(entries);
}

template <typename Scalar>
double SymmetricTiles<Scalar>::operator()(Index i, Index j) const {
  if (i > j) std::swap(i, j);
  const Index tile = find_tile(i / tile_size, j / tile_size);
  if (tile < 0) return 0;
  return scale_ * to_double(tile_data(tile)[(i % tile_size) * tile_size + j % tile_size]);
}

template <typename Scalar>
void SymmetricTiles<Scalar>::set(Index i, Index j, Scalar value) {
  if (i > j) std::swap(i, j);
  if (i < 0 || j >= size())
    throw std::out_of_range(fmt::format("entry ({}, {}) is outside a kernel of size {}", i, j, size()));
  const Index tile = find_tile(i / tile_size, j / tile_size);
  if (tile < 0) throw std::out_of_range(fmt::format("entry ({}, {}) lies in a tile that is not kept", i, j));
  const Index r = i % tile_size;
  const Index c = j % tile_size;
  tile_data(tile)[r * tile_size + c] = value;
  if (i / tile_size == j / tile_size) tile_data(tile)[c * tile_size + r] = value;
}

template <typename Scalar>
SymmetricTiles<Scalar> SymmetricTiles<Scalar>::without_zero_tiles() const {
  std::vector<char> kept(static_cast<std::size_t>(tile_count()));
  parallel_for(
      kept.size(),
      [&](std::size_t tile) {
        const Scalar* entries = tile_data(static_cast<Index>(tile));
        kept[tile] = std::any_of(entries, entries + tile_entries, [](Scalar e) { return to_double(e) != 0; });
      },
      16);
  SymmetricTiles copy(size(), [&](Index I, Index J) {
    const Index tile = find_tile(I, J);
    return tile >= 0 && kept[static_cast<std::size_t>(tile)];
  });
  copy.scale_ = scale_;
  Index next = 0;
  for (Index tile = 0; tile < tile_count(); ++tile)
    if (kept[static_cast<std::size_t>(tile)])
      std::memcpy(copy.tile_data(next++), tile_data(tile), tile_entries * sizeof(Scalar));
  return copy;
}

template <typename To, typename From>
SymmetricTiles<To> convert(const SymmetricTiles<From>& tiles) {
  SymmetricTiles<To> result(tiles.directory());
  // Between types of the same or growing range the stored numbers stay as they are.
  const double scale = sizeof(To) < sizeof(From) ? storage_scale<To>(largest_stored(tiles)) : 1.0;
  result.set_scale(tiles.scale() * scale);
  parallel_for(
      static_cast<std::size_t>(tiles.tile_count()),
      [&](std::size_t tile) {
        const From* from = tiles.tile_data(static_cast<Index>(tile));
        To* to = result.tile_data(static_cast<Index>(tile));
        for (Index k = 0; k < SymmetricTiles<To>::tile_entries; ++k)
          to[k] = round_to<To>(to_double(from[k]) / scale);
      },
      16);
  return result;
}

template <typename Scalar>
Eigen::MatrixXd materialize(const SymmetricTiles<Scalar>& tiles) {
  Eigen::MatrixXd matrix(tiles.size(), tiles.size());
  for (Index j = 0; j < tiles.size(); ++j)
    for (Index i = 0; i <= j; ++i) matrix(i, j) = matrix(j, i) = tiles(i, j);
  return matrix;
}

template class SymmetricTiles<double>;
template class SymmetricTiles<float>;
template class SymmetricTiles<Half>;

template SymmetricTiles<double> convert(const SymmetricTiles<double>&);
template SymmetricTiles<double> convert(const SymmetricTiles<float>&);
template SymmetricTiles<double> convert(const SymmetricTiles<Half>&);
template SymmetricTiles<float> convert(const SymmetricTiles<double>&);
template SymmetricTiles<float> convert(const SymmetricTiles<float>&);
template SymmetricTiles<float> convert(const SymmetricTiles<Half>&);
template SymmetricTiles<Half> convert(const SymmetricTiles<double>&);
template SymmetricTiles<Half> convert(const SymmetricTiles<float>&);
template SymmetricTiles<Half> convert(const SymmetricTiles<Half>&);

template Eigen::MatrixXd materialize(const SymmetricTiles<double>&);
template Eigen::MatrixXd materialize(const SymmetricTiles<float>&);
template Eigen::MatrixXd materialize(const SymmetricTiles<Half>&);

}  // namespace radiosity

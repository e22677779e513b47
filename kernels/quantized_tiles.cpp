#include "kernels/quantized_tiles.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace radiosity {

QuantizedTiles::QuantizedTiles(TileDirectory directory, int bits, int block)
    : directory_(std::move(directory)),
      bits_(bits),
      block_(block),
      exact_begin_(static_cast<std::size_t>(directory_.tile_count()) + 1) {
  if (bits != 0 && bits != 2 && bits != 4 && bits != 8)
    fail<UsageError>("codes of {} bits: there are 2, 4 and 8", bits);
  if (block != 16 && block != 32 && block != 64)
    fail<UsageError>("blocks of {} entries: there are 16, 32 and 64", block);
  record_bytes_ = steps_in_tile() * static_cast<Index>(sizeof(Half)) + tile_entries * bits / 8;
  records_.reset(static_cast<std::byte*>(
      allocate_zeroed(static_cast<std::size_t>(directory_.tile_count() * record_bytes_))));
}

void QuantizedTiles::set_code(Index tile, Index r, Index c, unsigned code) {
  const Index rows = 32 / bits_;
  std::byte* at = writable_record(tile) + steps_in_tile() * static_cast<Index>(sizeof(Half)) +
                  ((r / rows) * tile_size + c) * static_cast<Index>(sizeof(std::uint32_t));
  std::uint32_t word;
  std::memcpy(&word, at, sizeof word);
  const auto shift = static_cast<unsigned>(r % rows * bits_);
  word &= ~(static_cast<std::uint32_t>(largest_code()) << shift);
  word |= code << shift;
  std::memcpy(at, &word, sizeof word);
}

void QuantizedTiles::set_step(Index tile, Index r, Index block, Half step) {
  std::memcpy(writable_record(tile) + (r * (tile_size / block_) + block) * static_cast<Index>(sizeof(Half)),
              &step, sizeof step);
}

void QuantizedTiles::set_exact(const std::vector<ExactEntries>& tiles) {
  exact_position_.clear();
  exact_value_.clear();
  for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
    exact_position_.insert(exact_position_.end(), tiles[tile].position.begin(), tiles[tile].position.end());
    exact_value_.insert(exact_value_.end(), tiles[tile].value.begin(), tiles[tile].value.end());
    exact_begin_[tile + 1] = exact_value_.size();
  }
  exact_position_.shrink_to_fit();
  exact_value_.shrink_to_fit();
}

void QuantizedTiles::decode(Index tile, float* entries) const {
  std::fill(entries, entries + tile_entries, 0.0F);
  if (bits_ > 0) {
    const std::byte* steps = record(tile);
    const std::byte* codes = steps + steps_in_tile() * static_cast<Index>(sizeof(Half));
    const Index rows = 32 / bits_;
    for (Index r = 0; r < tile_size; ++r)
      for (Index c = 0; c < tile_size; ++c) {
        Half step;
        std::memcpy(&step, steps + (r * tile_size + c) / block_ * static_cast<Index>(sizeof step),
                    sizeof step);
        std::uint32_t word;
        std::memcpy(&word, codes + (r / rows * tile_size + c) * static_cast<Index>(sizeof word), sizeof word);
        const auto code = static_cast<int>(word >> (r % rows * bits_)) & largest_code();
        entries[r * tile_size + c] = static_cast<float>(code) * to_float(step);
      }
  }
  for (std::size_t k = exact_begin(tile); k < exact_begin(tile + 1); ++k)
    entries[exact_position_[k]] = exact_value_[k];
}

std::size_t QuantizedTiles::step_bytes() const {
  return static_cast<std::size_t>(directory_.tile_count() * steps_in_tile()) * sizeof(Half);
}

std::size_t QuantizedTiles::code_bytes() const {
  return static_cast<std::size_t>(directory_.tile_count() * record_bytes_) - step_bytes();
}

std::size_t QuantizedTiles::exact_bytes() const {
  return exact_value_.size() * (sizeof(float) + sizeof(std::uint16_t));
}

std::size_t QuantizedTiles::directory_bytes() const {
  return directory_.bytes() + exact_begin_.size() * sizeof(std::size_t);
}

Eigen::MatrixXd materialize(const QuantizedTiles& tiles) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(tiles.size(), tiles.size());
  constexpr Index size = QuantizedTiles::tile_size;
  std::array<float, QuantizedTiles::tile_entries> entries;
  const TileDirectory& directory = tiles.directory();
  for (Index I = 0; I < directory.tile_rows(); ++I)
    for (Index tile = directory.row_begin(I); tile < directory.row_begin(I + 1); ++tile) {
      tiles.decode(tile, entries.data());
      const Index J = directory.tile_column(tile);
      for (Index r = 0; r < std::min(size, tiles.size() - I * size); ++r)
        for (Index c = 0; c < std::min(size, tiles.size() - J * size); ++c) {
          const double entry =
              tiles.scale() * static_cast<double>(entries[static_cast<std::size_t>(r * size + c)]);
          matrix(I * size + r, J * size + c) += entry;
          matrix(J * size + c, I * size + r) += entry;
        }
    }
  return matrix;
}

}  // namespace radiosity

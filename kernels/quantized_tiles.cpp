#include "kernels/quantized_tiles.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

namespace radiosity {

QuantizedTiles::QuantizedTiles(TileDirectory directory, const TileFormat& format)
    : directory_(std::move(directory)),
      format_(format),
      record_bytes_(static_cast<std::ptrdiff_t>(format.record_bytes())),
      exact_begin_(static_cast<std::size_t>(directory_.tile_count()) + 1) {
  records_.reset(static_cast<std::byte*>(
      allocate_zeroed(static_cast<std::size_t>(directory_.tile_count() * record_bytes_))));
}

Index QuantizedTiles::steps_in_tile() const {
  return format_.code != EntryCode::steps || format_.bits == 0 ? 0 : tile_entries / format_.block;
}

void QuantizedTiles::set_code(Index tile, Index r, Index c, unsigned code) {
  if (format_.code == EntryCode::curve) {
    const bool pair = format_.bits == 4;
    std::byte& byte =
        writable_record(tile)[pair ? r * tile_size / 2 + c % (tile_size / 2) : r * tile_size + c];
    const unsigned shift = pair && c >= tile_size / 2 ? 4 : 0;
    const auto mask = static_cast<std::byte>(static_cast<unsigned>(largest_code()) << shift);
    byte = (byte & ~mask) | static_cast<std::byte>(code << shift);
    return;
  }
  const Index rows = 32 / format_.bits;
  std::byte* at = writable_record(tile) + steps_in_tile() * static_cast<Index>(sizeof(Half)) +
                  ((r / rows) * tile_size + c) * static_cast<Index>(sizeof(std::uint32_t));
  std::uint32_t word;
  std::memcpy(&word, at, sizeof word);
  const auto shift = static_cast<unsigned>(r % rows * format_.bits);
  word &= ~(static_cast<std::uint32_t>(largest_code()) << shift);
  word |= code << shift;
  std::memcpy(at, &word, sizeof word);
}

void QuantizedTiles::set_step(Index tile, Index r, Index block, Half step) {
  std::memcpy(
      writable_record(tile) + (r * (tile_size / format_.block) + block) * static_cast<Index>(sizeof(Half)),
      &step, sizeof step);
}

void QuantizedTiles::set_block(Index tile, Index row, Index column, const Bc4Block& block) {
  std::memcpy(writable_record(tile) + (row * (tile_size / 4) + column) * static_cast<Index>(sizeof block),
              &block, sizeof block);
}

void QuantizedTiles::set_number(Index tile, Index r, Index c, float number) {
  std::uint16_t bits;
  if (format_.code == EntryCode::half) {
    bits = to_half(number).bits;
  } else {
    const auto word = std::bit_cast<std::uint32_t>(number);
    bits = static_cast<std::uint16_t>((word + 0x7fff + (word >> 16 & 1)) >> 16);  // to nearest, ties to even
  }
  std::memcpy(writable_record(tile) + (r * tile_size + c) * static_cast<Index>(sizeof bits), &bits,
              sizeof bits);
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

float QuantizedTiles::stored_number(Index tile, Index r, Index c) const {
  const std::byte* at = record(tile);
  const auto read = [&](auto type, Index offset) {
    std::memcpy(&type, at + offset, sizeof type);
    return type;
  };
  switch (format_.code) {
    case EntryCode::steps: {
      const Index rows = 32 / format_.bits;
      const auto step = read(Half{}, (r * tile_size + c) / format_.block * 2);
      const auto word = read(std::uint32_t{}, 2 * steps_in_tile() + (r / rows * tile_size + c) * 4);
      const auto code = static_cast<int>(word >> (r % rows * format_.bits)) & largest_code();
      return static_cast<float>(code) * to_float(step);
    }
    case EntryCode::curve: {
      const bool pair = format_.bits == 4;
      const int byte =
          read(std::uint8_t{}, pair ? r * tile_size / 2 + c % (tile_size / 2) : r * tile_size + c);
      const int code = !pair ? byte : 17 * (c < tile_size / 2 ? byte & 15 : byte >> 4);
      return format_.curve.number(static_cast<float>(code));
    }
    case EntryCode::bc4: {
      const auto block = read(Bc4Block{}, (r / 4 * (tile_size / 4) + c / 4) * 8);
      const auto index = static_cast<std::size_t>(bc4_index(block, static_cast<int>(r % 4 * 4 + c % 4)));
      return bc4_numbers(block, format_.curve)[index];
    }
    case EntryCode::half:
      return to_float(read(Half{}, (r * tile_size + c) * 2));
    case EntryCode::brain:
      break;
  }
  return std::bit_cast<float>(static_cast<std::uint32_t>(read(std::uint16_t{}, (r * tile_size + c) * 2))
                              << 16);
}

void QuantizedTiles::decode_record(Index tile, float* entries) const {
  std::fill(entries, entries + tile_entries, 0.0F);
  if (record_bytes_ > 0)
    for (Index r = 0; r < tile_size; ++r)
      for (Index c = 0; c < tile_size; ++c) entries[r * tile_size + c] = stored_number(tile, r, c);
}

void QuantizedTiles::decode(Index tile, float* entries) const {
  decode_record(tile, entries);
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
          if (directory.symmetric() && (I != J || !tiles.whole_diagonal()))
            matrix(J * size + c, I * size + r) += entry;
        }
    }
  return matrix;
}

}  // namespace radiosity

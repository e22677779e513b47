// The decoding of one tile, written once for every instruction set. The including file defines, in an unnamed
// namespace so that nothing of it can be linked elsewhere, `Codes` with
//
//   Words of `width` 32-bit numbers and Vector of as many float numbers,
//   load_words(), store(),
//   widen(halves, steps, count): binary16 to float, count a multiple of 64,
//   Steps<bits>: what a block's codes multiply with, made from its step by Codes::steps<bits>(step), and
//   decode<bits, shift>(words, steps): code times step of the codes `shift` bits up, and
//   get_palettes<logarithmic>(blocks, curve, palettes): those of sixteen BC4 blocks side by side, a
//   Bc4Palettes, and store_bc4(blocks, palettes, entries): their texels.

namespace radiosity {
namespace {

template <int bits, int block>
class RecordDecoder {
 public:
  RecordDecoder(const std::byte* record, const std::byte* prefetch, float* entries)
      : words_(reinterpret_cast<const std::uint32_t*>(record + 2 * steps_in_tile)),
        prefetch_(prefetch),
        entries_(entries) {
    Codes::widen(reinterpret_cast<const std::uint16_t*>(record), steps_, steps_in_tile);
  }

  void run() const {
    for (int group = 0; group < groups; ++group) {
#pragma GCC unroll 8
      for (int byte = 0; byte < record_bytes / groups; byte += 64)
        __builtin_prefetch(prefetch_ + group * (record_bytes / groups) + byte);
      decode_group(group, std::make_integer_sequence<int, rows>{});
    }
  }

 private:
  static constexpr int rows = 32 / bits;
  static constexpr int groups = 64 / rows;
  static constexpr int steps_in_row = 64 / block;
  static constexpr int steps_in_tile = 64 * steps_in_row;
  static constexpr int record_bytes = 2 * steps_in_tile + 64 * 64 * bits / 8;
  static constexpr int vectors = 64 / Codes::width;
  static constexpr int vectors_in_block = block / Codes::width;

  template <int... row>
  [[gnu::always_inline]] inline void decode_group(int group, std::integer_sequence<int, row...>) const {
    typename Codes::Words words[vectors];
#pragma GCC unroll 16
    for (int v = 0; v < vectors; ++v) words[v] = Codes::load_words(words_ + group * 64 + v * Codes::width);
    (decode_row<row>(group, words), ...);
  }

  template <int row>
  [[gnu::always_inline]] inline void decode_row(int group,
                                                const typename Codes::Words (&words)[vectors]) const {
    const int r = group * rows + row;
#pragma GCC unroll 4
    for (int b = 0; b < steps_in_row; ++b) {
      const auto steps = Codes::template steps<bits>(steps_[r * steps_in_row + b]);
#pragma GCC unroll 16
      for (int v = b * vectors_in_block; v < (b + 1) * vectors_in_block; ++v)
        Codes::store(entries_ + r * 64 + v * Codes::width,
                     Codes::template decode<bits, row * bits>(words[v], steps));
    }
  }

  const std::uint32_t* words_;
  const std::byte* prefetch_;
  float* entries_;
  alignas(64) float steps_[steps_in_tile];
};

template <int bits, int block>
void decode_record(const std::byte* record, const std::byte* prefetch, const TileCurve&, float* entries) {
  RecordDecoder<bits, block>(record, prefetch, entries).run();
}

template <int bits>
TileDecoder decoder_for_block(int block) {
  if (block == 16) return decode_record<bits, 16>;
  if (block == 32) return decode_record<bits, 32>;
  return decode_record<bits, 64>;
}

/// As TileCurve::number has it.
template <bool logarithmic>
[[gnu::always_inline]] inline float on_tile_curve(float code, const TileCurve& curve) {
  const float scaled = code * curve.slope;
  if constexpr (!logarithmic) return scaled;
  const auto word = static_cast<std::int32_t>(scaled + curve.base) & (code > 0 ? -1 : 0);
  float number;
  std::memcpy(&number, &word, sizeof number);
  return number;
}

constexpr int tile_width = 64;

[[gnu::always_inline]] inline void fetch_line(const std::byte* prefetch, int byte) {
  __builtin_prefetch(prefetch + byte);
}

template <bool logarithmic>
void decode_bytes(const std::byte* record, const std::byte* prefetch, const TileCurve& curve,
                  float* entries) {
  const auto* codes = reinterpret_cast<const std::uint8_t*>(record);
  const TileCurve own = curve;
  for (int r = 0; r < tile_width; ++r) {
    fetch_line(prefetch, r * tile_width);
    for (int c = 0; c < tile_width; ++c)
      entries[r * tile_width + c] =
          on_tile_curve<logarithmic>(static_cast<float>(codes[r * tile_width + c]), own);
  }
}

/// The low four bits of byte c of a row are column c, the high four column c + 32.
template <bool logarithmic>
void decode_nibbles(const std::byte* record, const std::byte* prefetch, const TileCurve& curve,
                    float* entries) {
  const auto* codes = reinterpret_cast<const std::uint8_t*>(record);
  constexpr int half = tile_width / 2;
  const TileCurve own = curve;
  for (int r = 0; r < tile_width; ++r) {
    fetch_line(prefetch, r * half);
    for (int c = 0; c < half; ++c) {
      const int byte = codes[r * half + c];
      entries[r * tile_width + c] = on_tile_curve<logarithmic>(static_cast<float>(17 * (byte & 15)), own);
      entries[r * tile_width + half + c] =
          on_tile_curve<logarithmic>(static_cast<float>(17 * (byte >> 4)), own);
    }
  }
}

/// The palettes of a row of blocks are made while the texels of the one before it are stored: by itself each
/// is a chain of operations that wait for each other.
template <bool logarithmic>
void decode_blocks(const std::byte* record, const std::byte* prefetch, const TileCurve& curve,
                   float* entries) {
  constexpr int rows = tile_width / 4;
  const auto* blocks = reinterpret_cast<const std::uint64_t*>(record);
  const TileCurve own = curve;
  typename Codes::Bc4Palettes even;
  typename Codes::Bc4Palettes odd;
  Codes::template get_palettes<logarithmic>(blocks, own, even);
  for (int row = 0; row < rows; row += 2, blocks += 2 * rows, entries += 8 * tile_width) {
    for (int line = 0; line < 4; ++line) fetch_line(prefetch, row * 128 + line * 64);
    Codes::template get_palettes<logarithmic>(blocks + rows, own, odd);
    Codes::store_bc4(blocks, even, entries);
    if (row + 2 < rows) Codes::template get_palettes<logarithmic>(blocks + 2 * rows, own, even);
    Codes::store_bc4(blocks + rows, odd, entries + 4 * tile_width);
  }
}

inline void decode_halves(const std::byte* record, const std::byte* prefetch, const TileCurve&,
                          float* entries) {
  const auto* halves = reinterpret_cast<const std::uint16_t*>(record);
  for (int r = 0; r < tile_width; ++r) {
    fetch_line(prefetch, r * 128);
    fetch_line(prefetch, r * 128 + 64);
    Codes::widen(halves + r * tile_width, entries + r * tile_width, tile_width);
  }
}

inline void decode_brain_floats(const std::byte* record, const std::byte* prefetch, const TileCurve&,
                                float* entries) {
  const auto* upper = reinterpret_cast<const std::uint16_t*>(record);
  for (int r = 0; r < tile_width; ++r) {
    fetch_line(prefetch, r * 128);
    fetch_line(prefetch, r * 128 + 64);
    for (int c = 0; c < tile_width; ++c) {
      const auto word = static_cast<std::uint32_t>(upper[r * tile_width + c]) << 16;
      std::memcpy(entries + r * tile_width + c, &word, sizeof word);
    }
  }
}

TileDecoder decoder_of_steps(const TileFormat& format) {
  if (format.bits == 2) return decoder_for_block<2>(format.block);
  if (format.bits == 4) return decoder_for_block<4>(format.block);
  return decoder_for_block<8>(format.block);
}

template <bool logarithmic>
TileDecoder decoder_on_curve(const TileFormat& format) {
  if (format.code == EntryCode::bc4) return decode_blocks<logarithmic>;
  return format.bits == 4 ? decode_nibbles<logarithmic> : decode_bytes<logarithmic>;
}

TileDecoder decoder(const TileFormat& format) {
  if (format.code == EntryCode::steps) return decoder_of_steps(format);
  if (format.code == EntryCode::half) return decode_halves;
  if (format.code == EntryCode::brain) return decode_brain_floats;
  return format.curve.logarithmic ? decoder_on_curve<true>(format) : decoder_on_curve<false>(format);
}

}  // namespace
}  // namespace radiosity

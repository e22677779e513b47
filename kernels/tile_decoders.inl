// The decoding of one tile, written once for every instruction set. The including file defines, in an unnamed
// namespace so that nothing of it can be linked elsewhere, `Codes` with
//
//   Words of `width` 32-bit numbers and Vector of as many float numbers,
//   load_words(), store(),
//   widen(halves, steps, count): binary16 to float, count a multiple of 64,
//   Steps<bits>: what a block's codes multiply with, made from its step by Codes::steps<bits>(step), and
//   decode<bits, shift>(words, steps): code times step of the codes `shift` bits up.

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
void decode_record(const std::byte* record, const std::byte* prefetch, float* entries) {
  RecordDecoder<bits, block>(record, prefetch, entries).run();
}

template <int bits>
TileDecoder decoder_for_block(int block) {
  if (block == 16) return decode_record<bits, 16>;
  if (block == 32) return decode_record<bits, 32>;
  return decode_record<bits, 64>;
}

TileDecoder decoder(int bits, int block) {
  if (bits == 2) return decoder_for_block<2>(block);
  if (bits == 4) return decoder_for_block<4>(block);
  return decoder_for_block<8>(block);
}

}  // namespace
}  // namespace radiosity

// The product of a run of BC1 blocks, written once for every instruction set. The including file defines, in
// an unnamed namespace so that nothing of it can be linked elsewhere, `Texels` with
//
//   Vector of `width` floats and Words of as many 32-bit numbers,
//   load(), store(), zero(), load_words(), multiply_add(a, b, c) = a b + c, broadcast(), sum(),
//   indices<row>(words): each lane's word shifted so that its lowest two bits are the index of the texel in
//     `row` and in the lane's column (lane % 4),
//   select(palettes, indices): for each quarter vector of four palette entries those of the indices,
//   spread_indices(blocks, words): for a group, at 16 k + 4 l + c the indices of block 4 l + k, and
//   palettes<channel, logarithmic>(blocks, table, numbers): at 16 k + 4 l + e entry e of block 4 l + k.

namespace radiosity {
namespace {

template <int channels>
constexpr int colour_channel(int channel) {
  return channels == 1 ? 1 : channel;
}

/// A group of 16 blocks, taken apart.
template <int channels, bool logarithmic>
class TexelGroup {
 public:
  [[gnu::always_inline]] inline TexelGroup(const std::uint64_t* blocks, const float* tables) {
    Texels::spread_indices(blocks, words_);
    fill<0>(blocks, tables);
    if constexpr (channels == 3) {
      fill<1>(blocks, tables);
      fill<2>(blocks, tables);
    }
  }

  [[gnu::always_inline]] inline typename Texels::Words words(int v) const {
    return Texels::load_words(words_ + v * Texels::width);
  }
  [[gnu::always_inline]] inline typename Texels::Vector palettes(int channel, int v) const {
    return Texels::load(numbers_ + channel * texture_group + v * Texels::width);
  }

 private:
  template <int channel>
  [[gnu::always_inline]] inline void fill(const std::uint64_t* blocks, const float* tables) {
    constexpr int colour = colour_channel<channels>(channel);
    Texels::template palettes<colour, logarithmic>(blocks, tables + colour * texture_table,
                                                   numbers_ + channel * texture_group);
  }

  alignas(64) std::uint32_t words_[texture_group];
  alignas(64) float numbers_[channels * texture_group];
};

/// Two lines of a row of blocks a page ahead, where processors do not fetch by themselves.
[[gnu::always_inline]] inline void fetch_blocks_ahead(const std::uint64_t* blocks) {
  constexpr int blocks_ahead = 512;
  __builtin_prefetch(blocks + blocks_ahead);
  __builtin_prefetch(blocks + blocks_ahead + 8);
}

constexpr int vectors_of_group = texture_group / Texels::width;

template <int channels>
[[gnu::always_inline]] inline void all_indices(typename Texels::Words words,
                                               typename Texels::Words (&indices)[4]) {
  indices[0] = Texels::template indices<0>(words);
  indices[1] = Texels::template indices<1>(words);
  indices[2] = Texels::template indices<2>(words);
  indices[3] = Texels::template indices<3>(words);
}

template <int channels, bool logarithmic>
void multiply_to_rows(const TextureTask& task) {
  using Vector = typename Texels::Vector;
  Vector sums[channels][4];
  for (int channel = 0; channel < channels; ++channel)
    for (int r = 0; r < 4; ++r) sums[channel][r] = Texels::zero();
  for (int group = 0; group < task.groups; ++group) {
    fetch_blocks_ahead(task.blocks + 16 * group);
    const TexelGroup<channels, logarithmic> texels(task.blocks + 16 * group, task.tables);
    const float* x = task.x + channels * texture_group * group;
#pragma GCC unroll 4
    for (int v = 0; v < vectors_of_group; ++v) {
      typename Texels::Words indices[4];
      all_indices<channels>(texels.words(v), indices);
#pragma GCC unroll 3
      for (int channel = 0; channel < channels; ++channel) {
        const Vector palettes = texels.palettes(channel, v);
        const Vector numbers = Texels::load(x + channel * texture_group + v * Texels::width);
#pragma GCC unroll 4
        for (int r = 0; r < 4; ++r)
          sums[channel][r] =
              Texels::multiply_add(Texels::select(palettes, indices[r]), numbers, sums[channel][r]);
      }
    }
  }
  for (int channel = 0; channel < channels; ++channel)
    for (int r = 0; r < 4; ++r) task.y_rows[4 * channel + r] += Texels::sum(sums[channel][r]);
}

template <int channels, bool logarithmic>
void multiply_to_columns(const TextureTask& task) {
  using Vector = typename Texels::Vector;
  Vector x[channels][4];
  for (int channel = 0; channel < channels; ++channel)
    for (int r = 0; r < 4; ++r) x[channel][r] = Texels::broadcast(task.x_rows[4 * channel + r]);
  for (int group = 0; group < task.groups; ++group) {
    fetch_blocks_ahead(task.blocks + 16 * group);
    const TexelGroup<channels, logarithmic> texels(task.blocks + 16 * group, task.tables);
    float* y = task.y + channels * texture_group * group;
#pragma GCC unroll 4
    for (int v = 0; v < vectors_of_group; ++v) {
      typename Texels::Words indices[4];
      all_indices<channels>(texels.words(v), indices);
#pragma GCC unroll 3
      for (int channel = 0; channel < channels; ++channel) {
        const Vector palettes = texels.palettes(channel, v);
        float* at = y + channel * texture_group + v * Texels::width;
        Vector sum = Texels::load(at);
#pragma GCC unroll 4
        for (int r = 0; r < 4; ++r)
          sum = Texels::multiply_add(Texels::select(palettes, indices[r]), x[channel][r], sum);
        Texels::store(at, sum);
      }
    }
  }
}

template <int channels>
void to_rows(const TextureTask& task) {
  task.logarithmic ? multiply_to_rows<channels, true>(task) : multiply_to_rows<channels, false>(task);
}

template <int channels>
void to_columns(const TextureTask& task) {
  task.logarithmic ? multiply_to_columns<channels, true>(task) : multiply_to_columns<channels, false>(task);
}

void get_texture_products(TextureProducts& products) {
  products.to_rows[0] = to_rows<1>;
  products.to_rows[1] = to_rows<3>;
  products.to_columns[0] = to_columns<1>;
  products.to_columns[1] = to_columns<3>;
}

}  // namespace
}  // namespace radiosity

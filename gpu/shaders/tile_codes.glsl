// Blocks of 4 x 4 numbers from the records of quantized tiles (kernels/quantized_tiles.hpp), by the CODE of their format:
//   0  steps of BITS bits, one for BLOCK entries    1, 2  bytes and half bytes on a curve    3  BC4 on a curve
//   4  binary16                                     5     the upper half of binary32
// block_numbers(tile, row, column): entries (4 row + i, 4 column + j) of a tile, column i of the result for each row i.
layout(std430, binding = 0) readonly buffer Records { uvec2 pairs[]; };  // of words

uniform uint base_bits;   // of the curve (kernels/tile_format.hpp), floats as their bits
uniform uint slope_bits;

#if CODE == 1 || CODE == 2 || CODE == 3
#if LOGARITHMIC
// The bits of the numbers that codes stand for. A fused operation would change them in the fifth digit: base is near 2^30.
ivec4 bits_of(vec4 codes) {
  precise vec4 scaled = codes * uintBitsToFloat(slope_bits);
  precise vec4 sum = scaled + uintBitsToFloat(base_bits);
  return ivec4(sum);
}

vec4 on_curve(vec4 codes) {
  return mix(vec4(0), intBitsToFloat(bits_of(codes)), greaterThan(codes, vec4(0)));
}
#else
vec4 on_curve(vec4 codes) {
  return codes * uintBitsToFloat(slope_bits);
}
#endif
#endif

#if CODE == 0
const uint STEPS_OF_ROW = 64 / BLOCK;
const uint PAIRS_OF_STEPS = 16 * STEPS_OF_ROW;
const uint PAIRS_OF_TILE = PAIRS_OF_STEPS + 64 * BITS;
const uint ROWS_OF_WORD = 32 / BITS;

// One of the four in a pair of words.
float half_of(uvec2 four, uint place) {
  vec2 two = unpackHalf2x16(place < 2 ? four.x : four.y);
  return place % 2 == 0 ? two.x : two.y;
}

mat4 block_numbers(uint tile, uint row, uint column) {
  uint first = tile * PAIRS_OF_TILE + PAIRS_OF_STEPS + (4 * row / ROWS_OF_WORD) * 32 + 2 * column;
  uvec4 words = uvec4(pairs[first], pairs[first + 1]) >> (4 * row % ROWS_OF_WORD * BITS);
  mat4 numbers;
  for (uint i = 0; i < 4; ++i) {
    uvec2 four_steps = pairs[tile * PAIRS_OF_TILE + row * STEPS_OF_ROW + i * STEPS_OF_ROW / 4];
    float step = half_of(four_steps, (i * STEPS_OF_ROW + 4 * column / BLOCK) % 4);
    numbers[i] = vec4(words >> (i * BITS) & ((1u << BITS) - 1)) * step;
  }
  return numbers;
}
#elif CODE == 1
mat4 block_numbers(uint tile, uint row, uint column) {
  mat4 numbers;
  for (uint i = 0; i < 4; ++i) {
    uint codes = pairs[tile * 512 + (4 * row + i) * 8 + column / 2][column % 2];
    numbers[i] = on_curve(vec4(uvec4(codes) >> uvec4(0, 8, 16, 24) & 255u));
  }
  return numbers;
}
#elif CODE == 2
mat4 block_numbers(uint tile, uint row, uint column) {
  mat4 numbers;
  uint half_shift = column < 8 ? 0 : 4;  // a byte holds an entry and, above it, the one 32 columns on
  for (uint i = 0; i < 4; ++i) {
    uint codes = pairs[tile * 256 + (4 * row + i) * 4 + column % 8 / 2][column % 2];
    numbers[i] = on_curve(vec4(17 * (uvec4(codes) >> (uvec4(0, 8, 16, 24) + half_shift) & 15u)));
  }
  return numbers;
}
#elif CODE == 3
const float seventh = 1.0 / 7.0;
const float fifth = 1.0 / 5.0;

// The eight numbers of a block, by index (kernels/tile_format.hpp, bc4_numbers).
#if LOGARITHMIC
void palette(uint word, out vec4 low, out vec4 high) {
  vec2 ends = vec2(word & 0xffu, (word >> 8) & 0xffu);
  bool eight = ends.x > ends.y;
  ivec4 codes = bits_of(vec4(ends, 255, 0));
  int A = codes.x;
  int B = codes.y;
  precise float part = float(B - A) * (eight ? seventh : fifth);
  int step = int(part);
  int some = ends.x > 0 || ends.y > 0 ? -1 : 0;
  low = vec4(ends.x > 0 ? intBitsToFloat(A) : 0, ends.y > 0 ? intBitsToFloat(B) : 0,
             intBitsToFloat((A + step) & some), intBitsToFloat((A + 2 * step) & some));
  high = vec4(intBitsToFloat((A + 3 * step) & some), intBitsToFloat((A + 4 * step) & some),
              eight ? intBitsToFloat(A + 5 * step) : 0, intBitsToFloat(eight ? A + 6 * step : codes.z));
}
#else
void palette(uint word, out vec4 low, out vec4 high) {
  vec2 ends = vec2(word & 0xffu, (word >> 8) & 0xffu);
  bool eight = ends.x > ends.y;
  float slope = uintBitsToFloat(slope_bits);
  precise float A = ends.x * slope;
  precise float B = ends.y * slope;
  precise float step = (B - A) * (eight ? seventh : fifth);
  low = vec4(A, B, A + step, A + 2 * step);
  high = vec4(A + 3 * step, A + 4 * step, eight ? A + 5 * step : 0, eight ? A + 6 * step : 255 * slope);
}
#endif

vec4 chosen(vec4 four, bvec4 first_bit, bvec4 second_bit) {
  return mix(mix(four.xxxx, four.yyyy, first_bit), mix(four.zzzz, four.wwww, first_bit), second_bit);
}

// The indices of the four texels of a row, three bits each.
uint row_indices(uvec2 block, uint row) {
  if (row == 0) return block.x >> 16;
  if (row == 1) return block.x >> 28 | block.y << 4;
  return block.y >> (row == 2 ? 8 : 20);
}

mat4 block_numbers(uint tile, uint row, uint column) {
  uvec2 block = pairs[tile * 256 + row * 16 + column];
  vec4 low;
  vec4 high;
  palette(block.x, low, high);
  mat4 numbers;
  for (uint i = 0; i < 4; ++i) {
    uvec4 index = uvec4(row_indices(block, i)) >> uvec4(0, 3, 6, 9);
    bvec4 first_bit = notEqual(index & 1u, uvec4(0));
    bvec4 second_bit = notEqual(index & 2u, uvec4(0));
    bvec4 third_bit = notEqual(index & 4u, uvec4(0));
    numbers[i] = mix(chosen(low, first_bit, second_bit), chosen(high, first_bit, second_bit), third_bit);
  }
  return numbers;
}
#else
vec4 four_numbers(uvec2 pair) {
#if CODE == 4
  return vec4(unpackHalf2x16(pair.x), unpackHalf2x16(pair.y));
#else
  return uintBitsToFloat(uvec4(pair.x << 16, pair.x & 0xffff0000u, pair.y << 16, pair.y & 0xffff0000u));
#endif
}

mat4 block_numbers(uint tile, uint row, uint column) {
  mat4 numbers;
  for (uint i = 0; i < 4; ++i) numbers[i] = four_numbers(pairs[tile * 1024 + (4 * row + i) * 16 + column]);
  return numbers;
}
#endif

#pragma once

#include "kernels/block_formats.hpp"

#include <array>
#include <cstdint>

namespace radiosity {

/// Which number a code between 0 and 255 stands for, as a part of the largest. 0 is the number 0.
///   linear       code / 255
///   logarithmic  from e^-range (code 0, if it were not 0) to 1 (255), by the logarithm that the bits of a
///                binary32 number are: linear between powers of two, at most 6 % from the true one, three
///                instructions, and the same bits on every processor.
struct TileCurve {
  bool logarithmic = false;
  float base = 0;            ///< logarithmic: the bits of the number of code 0
  float slope = 1.0F / 255;  ///< linear: a code's number; logarithmic: bits a code

  static TileCurve linear() { return {}; }
  /// Throws UsageError unless 0 < range <= 80.
  static TileCurve logarithm(double range);

  /// The plain reference: in float arithmetic without fused operations.
  float number(float code) const;
  /// The code, not rounded, whose number is `part` of the largest, in [0, 255]; 0 for 0 and what lies below.
  double code(double part) const;
};

constexpr float bc4_seventh = 1 / 7.0F;
constexpr float bc4_fifth = 1 / 5.0F;

/// What the eight indices of a BC4 block of codes stand for on a curve: the plain reference. With A and B the
/// numbers of the block's two codes, the others follow in equal steps, (B - A) / 7 or / 5, computed
///   linear       in float without fused operations, as A + k step, step = (B - A) times float(1/7 or 1/5);
///   logarithmic  in the whole numbers that the bits of A and B are, with the step cut to a whole number and
///                its product taken in float: what interpolated codes stand for, but for the last bits. A
///                code of 0 is the number 0 where it is not between two codes, or between two that are 0.
std::array<float, 8> bc4_numbers(const Bc4Block& block, const TileCurve& curve);

/// How the entries of a tile are stored.
enum class EntryCode {
  steps,  ///< whole numbers of 2, 4 or 8 bits and a binary16 step for a block of entries; 0 bits: nothing
  curve,  ///< codes of 4 or 8 bits (of 255: those of 4 count by 17) on a curve
  bc4,    ///< BC4 blocks (kernels/block_formats.hpp) of codes on a curve
  half,   ///< binary16
  brain   ///< the upper half of binary32
};

struct TileFormat {
  EntryCode code = EntryCode::steps;
  int bits = 4;
  int block = 32;  ///< entries with one step: 16, 32 or 64
  TileCurve curve;

  /// Of a tile's record; a multiple of 64. Throws UsageError for formats that do not exist.
  std::int64_t record_bytes() const;
};

}  // namespace radiosity

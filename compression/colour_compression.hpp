#pragma once

#include "compression/bc1_codec.hpp"
#include "compression/colour_codes.hpp"
#include "compression/compressed_colours.hpp"

#include <functional>
#include <span>
#include <vector>

namespace radiosity {

/// How texels are stored.
enum class TexelCodec {
  bc1,  ///< blocks of all channels together, 4 bits a texel (document 000)
  bc4,  ///< blocks of one channel, 4 bits a texel
  u8,   ///< codes of 8 bits
  u4,   ///< codes of 4 bits
  f16,  ///< binary16
  bf16  ///< the upper half of binary32
};

struct ColourCompressionOptions {
  TexelCodec codec = TexelCodec::bc1;
  bool logarithmic = true;  ///< codes are logarithms, else proportional; no matter to f16 and bf16
  double range = 25;        ///< natural logarithms between codes 0 and 255; 0: what the numbers span
  double exact = 0.04;      ///< the part of each row of each channel that is kept in float32
  bool fill = false;        ///< texels of exact entries may be anything, else they are 0
  Bc1Fit fit = Bc1Fit::range;
};

/// The order of rows and columns, from the codes of the channels: order[p] is the row at place p.
using TexelOrder = std::function<std::vector<Index>(std::span<const CodeMatrix> codes)>;

/// Of the sum of what is not exact, what may fall below the range that range = 0 stands for.
constexpr double neglected_share = 1e-3;

/// Compresses one non-negative n x n matrix a channel (1 or 3) as document 000, section 3.5: the largest of
/// each row apart, codes of the rest, rows and columns in the given order, blocks. Throws UsageError for
/// options out of range and Error for entries that are negative, infinite or NaN.
CompressedColours compress_colours(std::span<const ColourMatrix> matrices,
                                   const ColourCompressionOptions& options, const TexelOrder& row_order);

/// The same for one symmetric matrix, of which the upper triangle is stored: tiles of any codec but bc1,
/// which is for three channels. As many entries are exact as with n rows of `exact` each, the largest of all.
struct CompressedKernel {
  QuantizedTiles tiles;  ///< in the order of places
  std::vector<Index> order;
};
CompressedKernel compress_kernel(const ColourMatrix& kernel, const ColourCompressionOptions& options,
                                 const TexelOrder& row_order);

}  // namespace radiosity

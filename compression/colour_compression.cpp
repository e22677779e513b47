#include "compression/colour_compression.hpp"

#include "compression/largest_of_rows.hpp"
#include "compression/largest_scores.hpp"
#include "compression/log_map.hpp"
#include "compression/texel_encoding.hpp"
#include "foundation/error.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

constexpr double least_range = 1;
constexpr double most_range = 80;

void check_matrices(std::span<const ColourMatrix> matrices, const ColourCompressionOptions& options) {
  for (const ColourMatrix& matrix : matrices)
    if (matrix.rows() != matrix.cols() || matrix.rows() != matrices.front().rows())
      fail<UsageError>("a matrix of {} x {} among the channels: all are n x n", matrix.rows(), matrix.cols());
  if (options.range != 0 && !(options.range > 0 && options.range <= most_range))
    fail<UsageError>("codes that span {} natural logarithms: take more than 0 and at most {}", options.range,
                     most_range);
}

/// A channel with the entries that are kept apart.
struct SplitChannel {
  const ColourMatrix& matrix;
  CsrMatrix<float> exact;
};

/// The range asked for, or the largest that a channel spans.
double chosen_range(const std::vector<SplitChannel>& channels, const ColourCompressionOptions& options) {
  if (options.range != 0 || !options.logarithmic) return options.range;
  double range = least_range;
  for (const SplitChannel& channel : channels)
    range = std::max(range, spanned_range(channel.matrix, channel.exact, neglected_share));
  return std::min(range, most_range);
}

TileFormat format_of(const ColourCompressionOptions& options, double range) {
  const TileCurve curve = options.logarithmic ? TileCurve::logarithm(range) : TileCurve::linear();
  switch (options.codec) {
    case TexelCodec::bc4:
      return {.code = EntryCode::bc4, .curve = curve};
    case TexelCodec::u8:
      return {.code = EntryCode::curve, .bits = 8, .curve = curve};
    case TexelCodec::u4:
      return {.code = EntryCode::curve, .bits = 4, .curve = curve};
    case TexelCodec::f16:
      return {.code = EntryCode::half, .curve = {}};
    case TexelCodec::bf16:
      return {.code = EntryCode::brain, .curve = {}};
    case TexelCodec::bc1:
      break;
  }
  fail<UsageError>("BC1 holds three channels: a single matrix is stored as bc4, u8, u4, f16 or bf16");
}

/// BC1's palettes follow the logarithm itself (kernels/colour_texture.hpp), tiles that of a float's bits.
CodeOfPart code_of(const ColourCompressionOptions& options, double range) {
  if (options.codec != TexelCodec::bc1) {
    const TileCurve curve = options.logarithmic ? TileCurve::logarithm(range) : TileCurve::linear();
    return [curve](double part) { return curve.code(part); };
  }
  if (!options.logarithmic) return [](double part) { return LogMap::largest_code * part; };
  return [map = LogMap(1, range)](double part) { return map.code(part); };
}

std::vector<CodedChannel> coded(std::vector<SplitChannel> channels, const CodeOfPart& code, bool fill) {
  std::vector<CodedChannel> all;
  all.reserve(channels.size());
  for (SplitChannel& channel : channels)
    all.push_back(code_channel(channel.matrix, std::move(channel.exact), code, fill));
  return all;
}

std::vector<Index> order_of(std::span<const CodedChannel> channels, const TexelOrder& row_order) {
  std::vector<CodeMatrix> codes;
  for (const CodedChannel& channel : channels) codes.push_back(channel.code);
  return row_order(codes);
}

/// Of a symmetric matrix the largest entries, `fraction` of all n^2 and both halves alike.
CsrMatrix<float> largest_pairs(const ColourMatrix& kernel, double fraction) {
  const Index n = kernel.rows();
  std::vector<std::vector<float>> scores(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i)
    scores[static_cast<std::size_t>(i)].assign(kernel.row(i).data() + i, kernel.row(i).data() + n);
  const auto pairs =
      static_cast<std::size_t>(std::llround(fraction * static_cast<double>(n) * static_cast<double>(n) / 2));
  std::vector<ScoreCut> cuts = cut_to_largest(scores, pairs);
  std::vector<std::vector<std::int32_t>> columns(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i)
    for (Index j = i; j < n; ++j) {
      if (!cuts[static_cast<std::size_t>(i)].takes(
              scores[static_cast<std::size_t>(i)][static_cast<std::size_t>(j - i)]))
        continue;
      columns[static_cast<std::size_t>(i)].push_back(static_cast<std::int32_t>(j));
      if (i != j) columns[static_cast<std::size_t>(j)].push_back(static_cast<std::int32_t>(i));
    }
  CsrMatrix<float> exact;
  exact.cols = n;
  for (Index i = 0; i < n; ++i) {
    auto& own = columns[static_cast<std::size_t>(i)];
    std::sort(own.begin(), own.end());
    for (const std::int32_t j : own) exact.value.push_back(kernel(i, j));
    exact.column.insert(exact.column.end(), own.begin(), own.end());
    exact.row_begin.push_back(static_cast<std::int64_t>(exact.value.size()));
  }
  return exact;
}

void check_entries(const ColourMatrix& kernel) {
  for (Index i = 0; i < kernel.rows(); ++i)
    for (Index j = 0; j < kernel.cols(); ++j)
      if (!(kernel(i, j) >= 0) || !std::isfinite(kernel(i, j)))
        fail("entry ({}, {}) of the kernel is {}: only finite numbers >= 0 are compressed", i, j,
             kernel(i, j));
}

}  // namespace

CompressedColours compress_colours(std::span<const ColourMatrix> matrices,
                                   const ColourCompressionOptions& options, const TexelOrder& row_order) {
  check_matrices(matrices, options);
  std::vector<SplitChannel> split;
  for (const ColourMatrix& matrix : matrices)
    split.push_back({matrix, largest_of_rows(matrix, options.exact)});
  const double range = chosen_range(split, options);
  const std::vector<CodedChannel> channels = coded(std::move(split), code_of(options, range), options.fill);
  std::vector<Index> order = order_of(channels, row_order);
  if (options.codec == TexelCodec::bc1) {
    TextureParts parts =
        encode_texture(channels, {options.logarithmic, range}, order, options.fit, options.fill);
    return {std::move(parts.texture), std::move(parts.exact), std::move(order)};
  }
  CompressedColours::Tiles tiles;
  for (std::size_t c = 0; c < channels.size(); ++c)
    tiles.push_back(
        encode_tiles(matrices[c], channels[c], format_of(options, range), order, false, options.fill));
  return {std::move(tiles), {}, std::move(order)};
}

CompressedKernel compress_kernel(const ColourMatrix& kernel, const ColourCompressionOptions& options,
                                 const TexelOrder& row_order) {
  check_matrices({&kernel, 1}, options);
  check_entries(kernel);
  std::vector<SplitChannel> split;
  split.push_back({kernel, largest_pairs(kernel, options.exact)});
  const double range = chosen_range(split, options);
  const TileFormat format = format_of(options, range);
  const std::vector<CodedChannel> channels = coded(std::move(split), code_of(options, range), options.fill);
  std::vector<Index> order = order_of(channels, row_order);
  QuantizedTiles tiles = encode_tiles(kernel, channels.front(), format, order, true, options.fill);
  return {std::move(tiles), std::move(order)};
}

}  // namespace radiosity

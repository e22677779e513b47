#include "experiments/dxt_radiosity/entry_histograms.hpp"

#include "compression/largest_of_rows.hpp"
#include "compression/log_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace radiosity {
namespace {

constexpr double minus_infinity = -std::numeric_limits<double>::infinity();

void count_factors(const Eigen::MatrixXd& F, EntryHistograms& histograms) {
  std::size_t small = 0;
  for (const double factor : F.reshaped()) {
    histograms.factors.add(factor);
    histograms.logarithms.add(factor > 0 ? std::log10(factor) : minus_infinity);
    if (factor < small_factor) ++small;
  }
  histograms.small = F.size() > 0 ? static_cast<double>(small) / static_cast<double>(F.size()) : 0;
}

/// Columns of the exact part of a row are rising.
bool is_exact(const CsrMatrix<float>& exact, Index row, Index column) {
  const auto begin = exact.column.begin() + exact.row_begin[static_cast<std::size_t>(row)];
  const auto end = exact.column.begin() + exact.row_begin[static_cast<std::size_t>(row) + 1];
  return std::binary_search(begin, end, static_cast<std::int32_t>(column));
}

struct RestCounts {
  std::size_t positive = 0;
  std::size_t beyond = 0;
};

void count_channel(const ColourMatrix& matrix, double fraction, EntryHistograms& histograms,
                   RestCounts& rest) {
  const LogMap map(1);
  const CodedChannel channel = code_channel(
      matrix, largest_of_rows(matrix, fraction), [&](double part) { return map.code(part); }, false);
  for (Index i = 0; i < matrix.rows(); ++i)
    for (Index j = 0; j < matrix.cols(); ++j) {
      histograms.codes.add(channel.code(i, j));
      const double number = matrix(i, j);
      const bool mapped = number > 0 && !is_exact(channel.exact, i, j);
      const double logarithm = mapped ? std::log(number / channel.largest) : minus_infinity;
      histograms.normalized.add(logarithm);
      if (!mapped) continue;
      ++rest.positive;
      if (logarithm < -LogMap::document_range) ++rest.beyond;
    }
}

}  // namespace

void Histogram::add(double number) {
  if (!(number >= low)) {
    ++below;
    return;
  }
  const double place = (number - low) / (high - low) * static_cast<double>(counts.size());
  const double last = static_cast<double>(counts.size()) - 1;
  ++counts[static_cast<std::size_t>(std::min(place, last))];
}

double Histogram::centre(std::size_t bin) const {
  return low + (static_cast<double>(bin) + 0.5) * (high - low) / static_cast<double>(counts.size());
}

std::uint64_t Histogram::total() const {
  return std::accumulate(counts.begin(), counts.end(), below);
}

EntryHistograms entry_histograms(const FormFactors& form_factors, const std::vector<ColourMatrix>& matrices,
                                 double exact) {
  const Eigen::MatrixXd F = form_factors.matrix();
  EntryHistograms histograms{.factors = {0, F.size() > 0 && F.maxCoeff() > 0 ? F.maxCoeff() : 1, 100},
                             .logarithms = {-12, 0, 96},
                             .normalized = {-30, 0, 120},
                             .codes = {-0.5, 255.5, 256}};
  count_factors(F, histograms);
  RestCounts rest;
  for (const ColourMatrix& matrix : matrices) count_channel(matrix, exact, histograms, rest);
  if (rest.positive > 0)
    histograms.beyond = static_cast<double>(rest.beyond) / static_cast<double>(rest.positive);
  return histograms;
}

}  // namespace radiosity

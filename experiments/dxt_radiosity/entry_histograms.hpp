#pragma once

#include "compression/colour_codes.hpp"
#include "form_factors/form_factors.hpp"

#include <cstdint>
#include <vector>

namespace radiosity {

/// Counts of numbers in bins of one width from `low` to `high`. Every number that is added is counted once:
/// those above `high` in the last bin, those below `low` apart.
struct Histogram {
  Histogram(double low_edge, double high_edge, std::size_t bins)
      : low(low_edge), high(high_edge), counts(bins, 0) {}

  void add(double number);
  double centre(std::size_t bin) const;
  std::uint64_t total() const;

  double low;
  double high;
  std::vector<std::uint64_t> counts;
  std::uint64_t below = 0;  ///< and what has no logarithm
};

/// What document 000 shows of its matrix.
struct EntryHistograms {
  Histogram factors;     ///< Figure 1: F, from 0 to its largest
  Histogram logarithms;  ///< log10 of F: Figure 1 over its whole range; zeros are below
  Histogram normalized;  ///< Figure 3: ln(v / max_c) of F^c without its exact part, which is below
  Histogram codes;       ///< Figure 4: the codes of F^c, 0 for the exact part and for zeros
  double small = 0;      ///< part of all entries of F below 0.005
  double beyond = 0;  ///< of the entries of F^c above 0 that are not exact, those below e^-25 of the largest
};

constexpr double small_factor = 0.005;

/// With the exact part of the document's size and its range of 25.
EntryHistograms entry_histograms(const FormFactors& form_factors, const std::vector<ColourMatrix>& matrices,
                                 double exact);

}  // namespace radiosity

#pragma once

#include "compression/colour_compression.hpp"
#include "form_factors/form_factors.hpp"
#include "operators/texel_order.hpp"

#include <vector>

namespace radiosity {

/// F^c of document 000, Eq. 5, one n x n matrix a channel.
std::vector<ColourMatrix> colour_form_factors(const FormFactors& form_factors);

/// How far a compressed matrix is from its original, over all entries and channels, absolute.
struct EntryErrors {
  double average = 0;
  double largest = 0;
  double total = 0;
};

/// |decoded - original| of numbers, not of codes: the errors of document 000, Figure 7.
EntryErrors entry_errors(const std::vector<ColourMatrix>& matrices, const CompressedColours& compressed);

/// The largest number that is not among the `exact` part of each row, over the channels: no compression that
/// keeps the exact part and decodes to at most the largest number errs by more.
double largest_compressed_entry(const std::vector<ColourMatrix>& matrices, double exact);

/// Bytes of texels, exact entries, their indices and the order, divided by n^2.
double bytes_per_entry(const CompressedColours& compressed);

}  // namespace radiosity

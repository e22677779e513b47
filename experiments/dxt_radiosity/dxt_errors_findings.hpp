#pragma once

#include "experiments/dxt_radiosity/dxt_errors.hpp"

#include <string>

namespace radiosity {

// Sentences whose numbers are computed from what was measured, and from what document 000 prints.

/// How many factors are small, and how many codes the document's range of 25 loses.
std::string histogram_finding(const DxtErrors& errors);
/// What reordering gains from a random order and from that of faces, against the document's factor.
std::string reordering_finding(const DxtErrors& errors);
/// Where Figure 7 contradicts itself and the text.
std::string published_table_finding(const DxtErrors& errors);
/// Bytes an entry against a scalar float32 F and a colour one.
std::string bytes_finding(const DxtErrors& errors);
/// The compressed sum against the iterated one-bounce matrix.
std::string bounces_finding(const DxtErrors& errors);
/// The best variant at the document's bytes, the kernel, and high reflectance, each against what is wanted.
std::string improvement_finding(const DxtErrors& errors, const DxtErrorsOptions& options);

}  // namespace radiosity

#pragma once

#include "experiments/svg_plot.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace radiosity {

/// One operator of a comparison, as the plot shows it.
struct ComparisonPoint {
  std::string label;         ///< the operator's spec
  double bytes = 0;          ///< > 0
  double apply_seconds = 0;  ///< > 0
  double error = 0;          ///< relative error in B, area-weighted, mean over the lights; >= 0
};

/// Two panels: error against bytes, and error against the time of one apply. Errors below 1e-10 (a solver's
/// rounding, not the operator's error) are drawn at the lower edge as such. Throws UsageError for no points
/// and for values out of range.
Plot comparison_plot(const std::vector<ComparisonPoint>& points, const std::string& title);

/// Writes the plot as SVG; appears whole or not at all.
void write_comparison_plot(const std::filesystem::path& file, const std::vector<ComparisonPoint>& points,
                           const std::string& title);

}  // namespace radiosity

#pragma once

#include "experiments/dxt_radiosity/colour_matrices.hpp"
#include "experiments/dxt_radiosity/entry_histograms.hpp"
#include "experiments/dxt_radiosity/light_answers.hpp"
#include "experiments/report.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// The errors of document 000's compressed matrix, and what makes them smaller.
struct DxtErrorsOptions {
  std::string scene = "cornell-box-closed";
  Index patches = 800;
  LightCounts lights = {.area = 4, .point = 4, .patch = 4};
  double high_reflectance = 0.99;
  std::vector<double> exact_parts = {0, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.09, 0.1};
  std::vector<long> bounces = {1, 2, 3};  ///< besides all of them
  std::uint64_t seed = 1;
};

/// A line of Figure 7: an order, and the errors of the document's variant in it.
struct ReorderingRow {
  TexelOrderChoice order;
  EntryErrors errors;
  double bytes_per_entry = 0;
};

/// A point of Figure 2.
struct ExactPartRow {
  double exact = 0;
  double without_order = 0;  ///< total error in the order of faces
  double ordered = 0;        ///< by rows and columns
  double filled = 0;         ///< ordered along curves, codes over what the numbers span, exact texels free
};

/// Mean errors after a number of bounces, against as many of T; empty `bounces`: all, against B.
struct BouncesRow {
  std::optional<long> bounces;
  std::string variant;                   ///< spec without its bounces
  AnswerErrors summed;                   ///< S_k compressed, applied once
  std::optional<AnswerErrors> iterated;  ///< the compressed one-bounce matrix, applied k times or solved
};

/// A step of what improves the compressed matrix.
struct ImprovementStep {
  std::string change;      ///< in words
  OperatorAnswer answer;   ///< with the reflectances of the scene
  OperatorAnswer at_high;  ///< with high_reflectance everywhere
};

struct DxtErrors {
  std::string scene;
  Index patches = 0;
  EntryHistograms histograms;
  std::vector<ReorderingRow> reorderings;
  double largest_compressed = 0;  ///< of what is not exact
  std::vector<ExactPartRow> exact_parts;
  std::vector<BouncesRow> bounces;
  std::vector<ImprovementStep> steps;

  /// The row of an order. Throws Error where there is none.
  const ReorderingRow& reordering(const std::string& start, const std::string& reorder) const;
  /// The step of a spec. Throws Error where there is none.
  const ImprovementStep& step(const std::string& spec) const;
};

/// Throws UsageError for a scene that is not of three channels.
DxtErrors measure_dxt_errors(const DxtErrorsOptions& options, const OperatorRegistry& operators,
                             const SolverRegistry& solvers, Monitor& monitor);

/// Tables and figures, the document's numbers beside ours.
ReportSection dxt_errors_section(const DxtErrors& errors, const DxtErrorsOptions& options,
                                 const std::string& command);

/// dxt_errors.json, dxt_errors.csv (the steps).
void write_dxt_errors(const std::filesystem::path& folder, const DxtErrors& errors);

/// Measures, writes dxt_errors.json and .csv into `folder` (made if it is missing), returns the section.
ReportSection dxt_errors(const std::filesystem::path& folder, const std::string& command,
                         const DxtErrorsOptions& options, const OperatorRegistry& operators,
                         const SolverRegistry& solvers, Monitor& monitor);

}  // namespace radiosity

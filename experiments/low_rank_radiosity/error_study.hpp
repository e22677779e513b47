#pragma once

#include "experiments/lights.hpp"
#include "experiments/report.hpp"
#include "foundation/monitor.hpp"
#include "operators/operator_registry.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// A way to make an operator of rank k.
struct LowRankFactorization {
  std::string name;     ///< in tables and plots
  std::string spec;     ///< without its k: "svd:norm=area"
  bool nested = false;  ///< whether the factors of a smaller k are leading columns of those of a larger one
};

/// Names that the findings speak of.
constexpr const char* plain_svd = "SVD";
constexpr const char* area_svd = "SVD, area norm";
constexpr const char* uniform_two_mesh = "2MSC, uniform";
constexpr const char* adaptive_two_mesh = "2MSC, adaptive";

/// Those of document 004 and what it compares them with or leaves open: SVD, QR, 2MSC in its forms, columns
/// and rows, wavelets, cosines.
std::vector<LowRankFactorization> studied_factorizations();

struct ErrorStudyOptions {
  std::vector<std::string> scenes = {"cube", "cornell-box-closed"};  ///< those not built in are left out
  Index patches = 800;
  std::vector<std::optional<double>> reflectances = {std::nullopt, 0.9};  ///< empty: the scene's own colours
  Index smallest_rank = 8;
  double rank_step = 3;                                         ///< ranks grow by this factor up to n/4
  LightCounts lights = {.area = 12, .point = 12, .patch = 12};  ///< what errors are measured with
  LightCounts training = {.area = 250, .point = 250};  ///< for the bound, and each patch as a patch light
  std::vector<LowRankFactorization> factorizations = studied_factorizations();
  std::uint64_t seed = 1;
};

/// A scene with one set of reflectances.
struct ErrorStudyProblem {
  std::string scene;
  Index patches = 0;
  std::optional<double> reflectance;  ///< empty: the scene's own colours

  bool operator==(const ErrorStudyProblem&) const = default;
  /// "cube, 864 patches, ρ = 0.9".
  std::string text() const;
};

/// Relative errors of the area norm over the lights of the study.
struct LightErrors {
  double radiosity_mean = 0;
  double radiosity_rms = 0;
  double radiosity_max = 0;
  double indirect_mean = 0;
  double indirect_max = 0;
  std::array<std::optional<double>, 3> of_kind;  ///< mean error in B of area, point and patch lights
};

/// One factorization at one k on one problem.
struct LowRankError {
  ErrorStudyProblem problem;
  std::string factorization;
  Index k = 0;     ///< as asked for
  Index rank = 0;  ///< of the operator: smaller where it found no more, 2 k for the two-sided 2MSC
  double bytes_per_patch = 0;
  double operator_error = 0;          ///< ||A - T||_F / ||T||_F of entries in the area norm
  double spectral_radius = 0;         ///< by power iteration, of the approximation
  std::optional<LightErrors> errors;  ///< empty: refused
  std::string refusal;                ///< why B does not exist; empty if it does
};

/// The bound beside them (BestRank), at one rank.
struct BestRankError {
  ErrorStudyProblem problem;
  Index rank = 0;
  LightErrors errors;  ///< of the best operator for all kinds of lights together
  /// Mean error in B of area, point and patch lights, of the best operators for lights of that kind alone.
  std::array<std::optional<double>, 3> alone;
};

/// Where the shelf of the spectrum comes from, for the kernel K of one scene.
struct SpectrumStudy {
  std::string scene;
  Index patches = 0;
  Index adjacent_pairs = 0;              ///< that share an edge and see each other
  std::vector<double> singular_values;   ///< of F, falling
  std::vector<double> eigenvalues;       ///< |.| of K, falling
  std::vector<double> without_adjacent;  ///< the same after K_ij = 0 for the adjacent pairs
};

struct ErrorStudy {
  std::vector<LowRankError> factorizations;
  std::vector<BestRankError> bounds;
  std::vector<SpectrumStudy> spectra;

  /// In the order of measurement.
  std::vector<ErrorStudyProblem> problems() const;
  /// The bound for a row's rank; null if it was not drawn for that rank.
  const BestRankError* bound(const ErrorStudyProblem& problem, Index rank) const;
};

/// k from options.smallest_rank by options.rank_step up to patches / 4, which is the last one; none if n/4 is
/// smaller than the smallest.
std::vector<Index> studied_ranks(Index patches, const ErrorStudyOptions& options);

/// What document 004 leaves open ("how the error in RF relates to the error in B"): each factorization at
/// each k, on every scene with every reflectance. References and bounds are dense: for a few thousand
/// patches. Throws UsageError if no scene is known.
ErrorStudy measure_low_rank_errors(const ErrorStudyOptions& options, const OperatorRegistry& operators,
                                   Monitor& monitor);

/// The study as text, tables and plots.
ReportSection error_study_section(const ErrorStudy& study, const std::string& command);

/// low_rank_errors.json, low_rank_errors.csv and low_rank_spectra.csv into `folder`, each whole or not at
/// all.
void write_error_study(const std::filesystem::path& folder, const ErrorStudy& study);

/// Measures, writes the files into `folder` (made if it is missing), returns the section.
ReportSection low_rank_errors(const std::filesystem::path& folder, const std::string& command,
                              const ErrorStudyOptions& options, const OperatorRegistry& operators,
                              Monitor& monitor);

}  // namespace radiosity

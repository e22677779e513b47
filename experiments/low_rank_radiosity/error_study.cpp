#include "experiments/low_rank_radiosity/error_study.hpp"

#include "experiments/low_rank_radiosity/error_study_bounds.hpp"
#include "experiments/low_rank_radiosity/error_study_measures.hpp"
#include "experiments/low_rank_radiosity/error_study_problem.hpp"
#include "experiments/low_rank_radiosity/error_study_spectrum.hpp"
#include "foundation/error.hpp"
#include "foundation/output_file.hpp"
#include "operators/low_rank_operator.hpp"
#include "scene/built_in.hpp"
#include "solvers/solver_registry.hpp"
#include "solvers/spectral_radius.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace radiosity {
namespace {

constexpr int radius_products = 20;
/// Of Woodbury's answer in double precision: far below every error that is measured.
constexpr double woodbury_tolerance = 1e-9;

/// Solves with the approximation by Woodbury's formula.
LowRankError measure_parts(const StudiedScene& scene, const StudiedProblem& studied,
                           const LowRankParts& parts, const Eigen::VectorXd& row_errors) {
  LowRankError row;
  row.problem = studied.problem;
  row.rank = parts.U.cols();
  row.bytes_per_patch = static_cast<double>(parts.bytes()) / static_cast<double>(studied.problem.patches);
  row.operator_error = relative_operator_error(studied.mesh().reflectance, row_errors, scene.kernel_rows);
  const LowRankOperator<double> transport(studied.form_factors, parts.U, parts.V, "studied");
  row.spectral_radius = collatz_wielandt_bounds(transport, radius_products).estimate;
  try {
    const auto solver = cpu_solvers().make(
        "woodbury", {transport, studied.mesh().area.cwiseSqrt(), {.tolerance = woodbury_tolerance}});
    row.errors = light_errors(studied.mesh(), studied.lights, studied.radiosity,
                              solve(*solver, studied.lights.emission));
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    row.refusal = error.what();
  }
  return row;
}

std::string spec_of_rank(const LowRankFactorization& factorization, Index k) {
  const char* const separator = factorization.spec.find(':') == std::string::npos ? ":" : ",";
  return fmt::format("{}{}k={}", factorization.spec, separator, k);
}

void measure_factorization(const StudiedScene& scene, const std::vector<StudiedProblem>& problems,
                           const LowRankFactorization& factorization, const OperatorRegistry& operators,
                           Monitor& monitor, ErrorStudy& study) {
  LowRankParts largest;
  if (factorization.nested)
    largest = low_rank_parts(operators, spec_of_rank(factorization, scene.ranks.back()), scene.form_factors);
  for (const Index k : scene.ranks) {
    monitor.checkpoint(fmt::format("{} of rank {} on {}", factorization.name, k, scene.name), 0);
    const LowRankParts parts =
        factorization.nested ? largest.leading(k)
                             : low_rank_parts(operators, spec_of_rank(factorization, k), scene.form_factors);
    const Eigen::VectorXd row_errors = squared_row_errors(scene.kernel, scene.form_factors.mesh->area, parts);
    for (const StudiedProblem& studied : problems) {
      LowRankError row = measure_parts(scene, studied, parts, row_errors);
      row.factorization = factorization.name;
      row.k = k;
      study.factorizations.push_back(std::move(row));
    }
  }
}

void measure_scene(const std::string& name, const ErrorStudyOptions& options,
                   const OperatorRegistry& operators, Monitor& monitor, ErrorStudy& study) {
  const StudiedScene scene = make_studied_scene(name, options, monitor);
  if (scene.ranks.empty())
    fail<UsageError>("{} patches of '{}' are too few to study ranks from {} to n/4.",
                     scene.form_factors.patch_count(), name, options.smallest_rank);
  monitor.checkpoint("spectrum of " + name, 0);
  study.spectra.push_back(study_spectrum(name, scene.form_factors, scene.kernel));
  std::vector<StudiedProblem> problems;
  for (const std::optional<double> reflectance : options.reflectances)
    problems.push_back(make_studied_problem(scene, reflectance, options, monitor));
  std::set<Index> ranks(scene.ranks.begin(), scene.ranks.end());
  const std::size_t first = study.factorizations.size();
  for (const LowRankFactorization& factorization : options.factorizations)
    measure_factorization(scene, problems, factorization, operators, monitor, study);
  for (std::size_t row = first; row < study.factorizations.size(); ++row)
    ranks.insert(study.factorizations[row].rank);
  for (const StudiedProblem& studied : problems) {
    const std::vector<BestRankError> bounds = measure_bounds(scene, studied, ranks, options, monitor);
    study.bounds.insert(study.bounds.end(), bounds.begin(), bounds.end());
  }
}

}  // namespace

std::vector<LowRankFactorization> studied_factorizations() {
  return {{plain_svd, "svd", true},
          {area_svd, "svd:norm=area", true},
          {"randomized SVD", "rsvd"},
          {"QR of 2MSC", "qr:mesh=uniform"},
          {"QR, pivoted", "qr:columns=pivoted"},
          {uniform_two_mesh, "2msc:mesh=uniform"},
          {"2MSC, sparse V", "sparse-v:mesh=uniform"},
          {adaptive_two_mesh, "2msc:mesh=adaptive"},
          {"2MSC, two sides", "2msc:mesh=uniform,sides=two"},
          {"CUR", "cur"},
          {"wavelets", "wavelet"},
          {"cosines", "dct"}};
}

std::string ErrorStudyProblem::text() const {
  return fmt::format("{}, {} patches, {}", scene, patches,
                     reflectance ? fmt::format("ρ = {}", *reflectance) : "its own colours");
}

std::vector<ErrorStudyProblem> ErrorStudy::problems() const {
  std::vector<ErrorStudyProblem> found;
  for (const BestRankError& bound : bounds)
    if (std::find(found.begin(), found.end(), bound.problem) == found.end()) found.push_back(bound.problem);
  return found;
}

const BestRankError* ErrorStudy::bound(const ErrorStudyProblem& problem, Index rank) const {
  for (const BestRankError& bound : bounds)
    if (bound.rank == rank && bound.problem == problem) return &bound;
  return nullptr;
}

std::vector<Index> studied_ranks(Index patches, const ErrorStudyOptions& options) {
  const Index last = patches / 4;
  std::vector<Index> ranks;
  for (auto k = static_cast<double>(options.smallest_rank);
       k * std::sqrt(options.rank_step) < static_cast<double>(last); k *= options.rank_step)
    ranks.push_back(static_cast<Index>(std::lround(k)));
  if (last >= options.smallest_rank) ranks.push_back(last);
  return ranks;
}

ErrorStudy measure_low_rank_errors(const ErrorStudyOptions& options, const OperatorRegistry& operators,
                                   Monitor& monitor) {
  ErrorStudy study;
  for (const std::string& scene : options.scenes)
    if (names_built_in_scene(scene)) measure_scene(scene, options, operators, monitor, study);
  if (study.factorizations.empty())
    fail<UsageError>("None of the {} scenes to study is built in.", options.scenes.size());
  return study;
}

ReportSection low_rank_errors(const std::filesystem::path& folder, const std::string& command,
                              const ErrorStudyOptions& options, const OperatorRegistry& operators,
                              Monitor& monitor) {
  make_folder(folder);
  const ErrorStudy study = measure_low_rank_errors(options, operators, monitor);
  write_error_study(folder, study);
  return error_study_section(study, command);
}

}  // namespace radiosity

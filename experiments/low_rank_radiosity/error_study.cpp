#include "experiments/low_rank_radiosity/error_study.hpp"

#include "experiments/low_rank_radiosity/error_study_measures.hpp"
#include "experiments/low_rank_radiosity/error_study_spectrum.hpp"
#include "experiments/reference_solution.hpp"
#include "foundation/error.hpp"
#include "operators/low_rank_operator.hpp"
#include "scene/built_in.hpp"
#include "solvers/solver_registry.hpp"
#include "solvers/spectral_radius.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <system_error>
#include <utility>

namespace radiosity {
namespace {

/// Lights of the training set come from seeds that no light of the study has.
constexpr std::uint64_t training_seed_offset = 1000003;
constexpr double diagonal_share = 0.01;
constexpr int radius_products = 20;
/// Of Woodbury's answer in double precision: far below every error that is measured.
constexpr double woodbury_tolerance = 1e-9;

/// One scene: what does not depend on reflectances.
struct StudiedScene {
  std::string name;
  FormFactors form_factors;
  Eigen::MatrixXd kernel;       ///< K
  Eigen::VectorXd kernel_rows;  ///< squared lengths of its rows
  std::vector<Index> ranks;
};

/// One scene with one set of reflectances, and its lights solved.
struct StudiedProblem {
  ErrorStudyProblem problem;
  FormFactors form_factors;
  LightSet lights;
  Field radiosity;

  const PatchMesh& mesh() const { return *form_factors.mesh; }
};

StudiedScene make_studied_scene(const std::string& name, const ErrorStudyOptions& options, Monitor& monitor) {
  const auto mesh =
      std::make_shared<const PatchMesh>(make_patches(built_in_scene(name), {.patches = options.patches}));
  FormFactors form_factors = compute_form_factors(mesh, {.seed = options.seed}, monitor);
  Eigen::MatrixXd kernel = materialize(*form_factors.kernel);
  Eigen::VectorXd rows = kernel.rowwise().squaredNorm();
  return {name, std::move(form_factors), std::move(kernel), std::move(rows),
          studied_ranks(mesh->patch_count(), options)};
}

FormFactors with_grey(const FormFactors& form_factors, std::optional<double> reflectance) {
  if (!reflectance) return form_factors;
  FormFactors changed = form_factors;
  auto mesh = std::make_shared<PatchMesh>(*form_factors.mesh);
  mesh->reflectance = Eigen::MatrixXd::Constant(mesh->patch_count(), 1, *reflectance);
  mesh->emission = Eigen::MatrixXd::Zero(mesh->patch_count(), 1);
  changed.mesh = std::move(mesh);
  return changed;
}

StudiedProblem make_problem(const StudiedScene& scene, std::optional<double> reflectance,
                            const ErrorStudyOptions& options, Monitor& monitor) {
  StudiedProblem made;
  made.problem = {scene.name, scene.form_factors.patch_count(), reflectance};
  made.form_factors = with_grey(scene.form_factors, reflectance);
  made.lights = draw_lights(made.mesh(), options.lights, options.seed, monitor);
  made.radiosity = solve_densely(scene.kernel, made.mesh(), made.lights.emission);
  return made;
}

/// Lights one after the other: area lights, points, each patch.
struct TrainingLights {
  SolvedLights lights;
  LightCounts counts;
};

TrainingLights training_lights(const StudiedScene& scene, const PatchMesh& mesh,
                               const ErrorStudyOptions& options, Monitor& monitor) {
  TrainingLights training;
  training.counts = options.training;
  training.counts.patch = 0;
  const LightSet drawn = draw_lights(mesh, training.counts, options.seed + training_seed_offset, monitor);
  const Index drawn_count = training.counts.total();
  training.counts.patch = mesh.patch_count();
  Field emission = Field::Zero(mesh.patch_count(), training.counts.total() * mesh.channels());
  emission.leftCols(drawn.emission.cols()) = drawn.emission;
  for (Index patch = 0; patch < training.counts.patch; ++patch)
    emission.block(patch, (drawn_count + patch) * mesh.channels(), 1, mesh.channels()).setOnes();
  training.lights.radiosity = solve_densely(scene.kernel, mesh, emission);
  training.lights.emission = std::move(emission);
  return training;
}

std::array<Index, 3> by_kind(const LightCounts& counts) {
  return {counts.area, counts.point, counts.patch};
}

/// Every kind as probable as it is among `lights`, every training light of a kind as the next; patch lights
/// at least as probable as `diagonal_share`, which is the multiple of the identity that a covariance of few
/// area and point lights needs to serve others.
Eigen::VectorXd probabilities(const LightCounts& training, const LightCounts& lights) {
  Eigen::VectorXd probability(training.total());
  Index first = 0;
  for (std::size_t kind = 0; kind < by_kind(training).size(); ++kind) {
    const Index count = by_kind(training)[kind];
    double share = static_cast<double>(by_kind(lights)[kind]) / static_cast<double>(lights.total());
    if (kind == static_cast<std::size_t>(LightKind::patch)) share = std::max(share, diagonal_share);
    probability.segment(first, count).setConstant(share / static_cast<double>(std::max<Index>(count, 1)));
    first += count;
  }
  return probability;
}

/// BestRankError::alone at every rank.
void measure_bounds_alone(const StudiedProblem& studied, const TrainingLights& training,
                          const LightCounts& counts, const std::vector<BestRankError*>& bounds) {
  const PatchMesh& mesh = studied.mesh();
  const SolvedLights solved = {studied.lights.emission, studied.radiosity};
  const std::array<LightCounts, 3> alone = {LightCounts{.area = counts.area},
                                            LightCounts{.point = counts.point},
                                            LightCounts{.patch = counts.patch}};
  Index first = 0;
  for (std::size_t kind = 0; kind < alone.size(); ++kind) {
    const Index count = alone[kind].total();
    if (count == 0) continue;
    const BestRank best(mesh, training.lights, probabilities(training.counts, alone[kind]));
    const SolvedLights lights = solved.part(mesh, first, count);
    for (BestRankError* bound : bounds)
      bound->alone[kind] =
          mean_of(relative_errors(mesh, best.radiosity(bound->rank, lights), lights.radiosity));
    first += count;
  }
}

void measure_bounds(const StudiedScene& scene, const StudiedProblem& studied,
                    const ErrorStudyOptions& options, const std::set<Index>& ranks, Monitor& monitor,
                    ErrorStudy& study) {
  monitor.checkpoint("best of rank k on " + scene.name, 0);
  const TrainingLights training = training_lights(scene, studied.mesh(), options, monitor);
  const BestRank best(studied.mesh(), training.lights, probabilities(training.counts, options.lights));
  const std::size_t first = study.bounds.size();
  for (const Index rank : ranks)
    study.bounds.push_back({studied.problem,
                            rank,
                            light_errors(studied.mesh(), studied.lights, studied.radiosity,
                                         best.radiosity(rank, {studied.lights.emission, studied.radiosity})),
                            {}});
  std::vector<BestRankError*> bounds;
  bounds.reserve(ranks.size());
  for (std::size_t bound = first; bound < study.bounds.size(); ++bound)
    bounds.push_back(&study.bounds[bound]);
  measure_bounds_alone(studied, training, options.lights, bounds);
}

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
    problems.push_back(make_problem(scene, reflectance, options, monitor));
  std::set<Index> ranks(scene.ranks.begin(), scene.ranks.end());
  const std::size_t first = study.factorizations.size();
  for (const LowRankFactorization& factorization : options.factorizations)
    measure_factorization(scene, problems, factorization, operators, monitor, study);
  for (std::size_t row = first; row < study.factorizations.size(); ++row)
    ranks.insert(study.factorizations[row].rank);
  for (const StudiedProblem& studied : problems)
    measure_bounds(scene, studied, options, ranks, monitor, study);
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
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) fail("cannot make the folder '{}': {}", folder.string(), error.message());
  const ErrorStudy study = measure_low_rank_errors(options, operators, monitor);
  write_error_study(folder, study);
  return error_study_section(study, command);
}

}  // namespace radiosity

#include "experiments/low_rank_radiosity/error_study_bounds.hpp"

#include "experiments/low_rank_radiosity/best_rank.hpp"
#include "experiments/low_rank_radiosity/error_study_measures.hpp"
#include "experiments/reference_solution.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace radiosity {
namespace {

/// Lights of the training set come from seeds that no light of the study has.
constexpr std::uint64_t training_seed_offset = 1000003;
constexpr double diagonal_share = 0.01;

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
                          const LightCounts& counts, std::vector<BestRankError>& bounds) {
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
    for (BestRankError& bound : bounds)
      bound.alone[kind] =
          mean_of(relative_errors(mesh, best.radiosity(bound.rank, lights), lights.radiosity));
    first += count;
  }
}

}  // namespace

std::vector<BestRankError> measure_bounds(const StudiedScene& scene, const StudiedProblem& studied,
                                          const std::set<Index>& ranks, const ErrorStudyOptions& options,
                                          Monitor& monitor) {
  monitor.checkpoint("best of rank k on " + scene.name, 0);
  const TrainingLights training = training_lights(scene, studied.mesh(), options, monitor);
  const BestRank best(studied.mesh(), training.lights, probabilities(training.counts, options.lights));
  std::vector<BestRankError> bounds;
  bounds.reserve(ranks.size());
  for (const Index rank : ranks)
    bounds.push_back({studied.problem,
                      rank,
                      light_errors(studied.mesh(), studied.lights, studied.radiosity,
                                   best.radiosity(rank, {studied.lights.emission, studied.radiosity})),
                      {}});
  measure_bounds_alone(studied, training, options.lights, bounds);
  return bounds;
}

}  // namespace radiosity

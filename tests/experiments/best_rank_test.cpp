#include "experiments/low_rank_radiosity/best_rank.hpp"
#include "experiments/low_rank_radiosity/error_study_measures.hpp"
#include "experiments/reference_solution.hpp"
#include "foundation/error.hpp"
#include "operators/low_rank_operator.hpp"
#include "scene/built_in.hpp"
#include "solvers/solver_registry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace radiosity::testing {
namespace {

constexpr Index studied_rank = 12;

/// A small coloured room, lit by a distribution that every check measures on itself.
struct LitRoom {
  FormFactors form_factors;
  Eigen::MatrixXd kernel;
  LightSet set;
  SolvedLights lights;

  const PatchMesh& mesh() const { return *form_factors.mesh; }
  Index count() const { return lights.count(mesh()); }
};

const LitRoom& lit_room() {
  static const LitRoom room = [] {
    SilentMonitor monitor;
    LitRoom made;
    made.form_factors = compute_form_factors(
        std::make_shared<PatchMesh>(make_patches(built_in_scene("cornell-box-closed"), {.patches = 100})), {},
        monitor);
    made.kernel = materialize(*made.form_factors.kernel);
    made.set = draw_lights(made.mesh(), {.area = 15, .point = 15, .patch = 30}, 1, monitor);
    made.lights = {made.set.emission, solve_densely(made.kernel, made.mesh(), made.set.emission)};
    return made;
  }();
  return room;
}

Eigen::VectorXd even_probability(Index count) {
  return Eigen::VectorXd::Constant(count, 1 / static_cast<double>(count));
}

double root_mean_square(const Field& radiosity) {
  const std::vector<double> errors =
      relative_errors(lit_room().mesh(), radiosity, lit_room().lights.radiosity);
  double sum = 0;
  for (const double error : errors) sum += error * error;
  return std::sqrt(sum / static_cast<double>(errors.size()));
}

double best_error(Index rank) {
  const BestRank best(lit_room().mesh(), lit_room().lights, even_probability(lit_room().count()));
  return root_mean_square(best.radiosity(rank, lit_room().lights));
}

TEST(BestRank, NoOperatorOfTheSameRankIsBelowIt) {
  const LitRoom& room = lit_room();
  const OperatorRegistry operators = cpu_operators();
  for (const LowRankFactorization& factorization : studied_factorizations()) {
    const std::string spec =
        factorization.spec + (factorization.spec.find(':') == std::string::npos ? ":k=12" : ",k=12");
    const auto transport = operators.make(spec, room.form_factors);
    const Index rank = dynamic_cast<const LowRankFactors&>(*transport).rank();
    const auto solver =
        cpu_solvers().make("woodbury", {*transport, room.mesh().area.cwiseSqrt(), {.tolerance = 1e-6}});
    const double error = root_mean_square(solve(*solver, room.lights.emission));
    EXPECT_GE(error, best_error(rank) * (1 - 1e-5)) << spec;
    EXPECT_GT(error, 0) << spec;
  }
}

TEST(BestRank, AllOfThemAreExactAndNoneIsTheLightItself) {
  const LitRoom& room = lit_room();
  EXPECT_LE(best_error(room.count()), 1e-7);
  const BestRank best(room.mesh(), room.lights, even_probability(room.count()));
  EXPECT_EQ(best.radiosity(0, room.lights), room.lights.emission);
  EXPECT_GT(best_error(studied_rank), 1e-3) << "a bound of zero would bound nothing";
}

TEST(BestRank, FallsWithRankAndIsBrokenByWrongDirections) {
  double before = best_error(0);
  for (const Index rank : {1, 2, 4, 8, 16, 32}) {
    const double error = best_error(rank);
    EXPECT_LT(error, before) << rank;
    before = error;
  }
  // Trained on other lights it is no bound: directions of patch lights alone serve area lights worse.
  const LitRoom& room = lit_room();
  const BestRank of_patches(room.mesh(), room.lights.part(room.mesh(), 30, 30), even_probability(30));
  EXPECT_GT(root_mean_square(of_patches.radiosity(studied_rank, room.lights)),
            1.05 * best_error(studied_rank));
}

// The route of eigenvectors (more lights than patches) and that of singular vectors agree.
TEST(BestRank, RepeatedLightsChangeNothing) {
  const LitRoom& room = lit_room();
  const Index copies = room.mesh().patch_count() / room.count() + 2;
  const SolvedLights repeated = {room.lights.emission.replicate(1, copies),
                                 room.lights.radiosity.replicate(1, copies)};
  ASSERT_GT(repeated.count(room.mesh()), room.mesh().patch_count());
  const BestRank best(room.mesh(), repeated, even_probability(repeated.count(room.mesh())));
  EXPECT_NEAR(root_mean_square(best.radiosity(studied_rank, room.lights)), best_error(studied_rank), 1e-9);
}

TEST(BestRank, RefusesLightsWithoutProbabilities) {
  const LitRoom& room = lit_room();
  EXPECT_THROW(BestRank(room.mesh(), room.lights, even_probability(room.count() - 1)), UsageError);
}

}  // namespace
}  // namespace radiosity::testing

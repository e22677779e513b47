#include "factorizations/lapack.hpp"
#include "foundation/error.hpp"
#include "foundation/random.hpp"
#include "room_operators.hpp"
#include "solvers/error_certificate.hpp"
#include "solvers/patch_error_bounds.hpp"
#include "solvers/radau_bound.hpp"
#include "solvers/solver_registry.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace radiosity::testing {
namespace {

/// Exact answers and answers that are wrong in many ways, for lights of many kinds.
struct Trials {
  Field emission, truth, answers;
};

/// Noise smooth and rough, a wrong kernel, too few bounces, answers times a factor.
Trials draw_trials(const Room& room, Index count, std::uint64_t seed) {
  const Index n = room.size();
  const Eigen::MatrixXd T = room.transport(0);
  Trials trials;
  trials.emission = random_lights(n, count, seed);
  for (Index j = 0; j < count; j += 3)
    trials.emission.col(j).array() *= (trials.emission.col(j).array() > 0.9).cast<double>();
  trials.truth = LuFactors(Eigen::MatrixXd::Identity(n, n) - T).solve(trials.emission);
  trials.answers = trials.truth;
  RandomStream random(seed, 77);
  for (Index j = 0; j < count; ++j) {
    const double size = std::pow(10, random.uniform(-6, -1));
    const Eigen::VectorXd noise =
        random_lights(n, 1, mix_bits(seed) + static_cast<std::uint64_t>(j)).col(0).array() - 0.5;
    Eigen::VectorXd error = noise;
    if (j % 4 == 1) error = (T * T * T * noise).eval();
    if (j % 4 == 2) error = trials.truth.col(j);
    if (j % 4 == 3) error = noise.array() + 0.5;
    const Eigen::VectorXd reflects = (room.reflectance.col(0).array() > 0).cast<double>();
    trials.answers.col(j) += size * trials.truth.col(j).norm() / error.norm() * reflects.cwiseProduct(error);
  }
  return trials;
}

struct Ratios {
  double low = 1e300, high = 0;
};

Ratios ratios_of(const ErrorBound& bound, const Room& room, const Trials& trials) {
  const Eigen::RowVectorXd actual = area_norms(room.root_area(), Field(trials.answers - trials.truth));
  Ratios ratios;
  for (Index j = 0; j < actual.size(); ++j) {
    ratios.low = std::min(ratios.low, bound.absolute[j] / actual[j]);
    ratios.high = std::max(ratios.high, bound.absolute[j] / actual[j]);
  }
  return ratios;
}

Ratios bound_over_actual(const Room& room, const ErrorCertificate& certificate, const Trials& trials) {
  return ratios_of(certificate.bound(trials.emission, trials.answers), room, trials);
}

TEST(ErrorCertificate, HoldsInTenThousandTrials) {
  std::uint64_t seed = 1;
  for (const int rooms : {1, 2, 5, 10})
    for (const double reflectance : {0.5, 0.9, 0.99, 0.999, 0.9999}) {
      const Room chain = chained_rooms(rooms, 120 / rooms, 0.02, seed, reflectance);
      const RoomKernel truth(chain);
      const ErrorCertificate certificate(truth);
      const Trials trials = draw_trials(chain, 500, ++seed);
      const Ratios ratios = bound_over_actual(chain, certificate, trials);
      EXPECT_GE(ratios.low, 1) << rooms << " rooms, " << reflectance;
      EXPECT_LE(ratios.high, 4) << rooms << " rooms, " << reflectance;
      // The same trials by quadrature, which is within its 30 % or, where steps run out, holds all the same.
      const RadauBound radau = radau_error_bound(truth, trials.emission, trials.answers, {.most_steps = 30});
      const Ratios by_quadrature = ratios_of(radau.bound, chain, trials);
      EXPECT_GE(by_quadrature.low, 1) << rooms << " rooms, " << reflectance;
      if (radau.tight) {
        EXPECT_LE(by_quadrature.high, 1.31) << rooms << " rooms, " << reflectance;
      } else {
        EXPECT_GT(reflectance, 0.95) << rooms << " rooms";
      }
      if (reflectance > 0.95) {
        EXPECT_GE(certificate.vectors(), rooms);
      }
    }
}

TEST(ErrorCertificate, HoldsWithBlackPatchesAndColours) {
  const Room room = open_room(120, 5, 1);
  const RoomKernel truth(room);
  const ErrorCertificate certificate(truth);
  EXPECT_GE(bound_over_actual(room, certificate, draw_trials(room, 300, 6)).low, 1);
  // An answer that is wrong where nothing reflects.
  Trials trials = draw_trials(room, 3, 7);
  for (Index i = 2; i < room.size(); i += 5) trials.answers(i, 0) += 0.1;
  const Ratios ratios = bound_over_actual(room, certificate, trials);
  EXPECT_GE(ratios.low, 1);
}

TEST(ErrorCertificate, IsProvedWhereRowsSuffice) {
  const Room room = closed_room(60, 3, 0.4);
  const RoomKernel truth(room);
  const ErrorCertificate certificate(truth);
  EXPECT_EQ(certificate.kind(), "proved");
  EXPECT_EQ(certificate.confidence(), 1);
  EXPECT_EQ(certificate.vectors(), 0);
  const Ratios ratios = bound_over_actual(room, certificate, draw_trials(room, 100, 4));
  EXPECT_GE(ratios.low, 1);
  EXPECT_LE(ratios.high, 4);
}

TEST(ErrorCertificate, DroppingAModeIsNoticed) {
  // Two rooms, one vector: what is left has an eigenvalue near 1, and no honest bound is below 4 times the
  // error.
  const Room chain = chained_rooms(2, 60, 0.01, 3, 0.9999);
  const RoomKernel truth(chain);
  ErrorCertificateOptions options;
  options.most_vectors = 1;
  const ErrorCertificate certificate(truth, options);
  const Ratios ratios = bound_over_actual(chain, certificate, draw_trials(chain, 200, 4));
  EXPECT_GE(ratios.low, 1);
  EXPECT_GT(ratios.high, 4);
}

TEST(ErrorCertificate, SaysNothingOfASingularRoom) {
  const Room room = closed_room(40, 3, 1);
  const RoomKernel truth(room);
  const ErrorCertificate certificate(truth);
  const ErrorBound bound = certificate.bound(Field::Ones(40, 1), Field::Ones(40, 1));
  EXPECT_TRUE(std::isinf(bound.absolute[0]) || bound.absolute[0] > 1e6);
}

TEST(ErrorCertificate, RefusesWrongShapes) {
  const Room room = closed_room(10, 3, 0.5);
  const RoomKernel truth(room);
  const ErrorCertificate certificate(truth);
  EXPECT_THROW(certificate.bound(Field::Ones(9, 1), Field::Ones(9, 1)), UsageError);
  EXPECT_THROW(certificate.bound(Field::Ones(10, 1), Field::Ones(10, 2)), UsageError);
}

TEST(PatchErrorBounds, HoldOnEveryPatch) {
  for (const double reflectance : {0.5, 0.9, 0.99}) {
    const Room chain = chained_rooms(2, 40, 0.02, 8, reflectance);
    const RoomKernel truth(chain);
    const Trials trials = draw_trials(chain, 60, 9);
    const Field bounds = patch_error_bounds(truth, trials.emission, trials.answers);
    const Field errors = (trials.answers - trials.truth).cwiseAbs();
    EXPECT_GE((bounds - errors).minCoeff(), 0) << reflectance;
    // Without its sign a residual may count as often as light goes round, but no more.
    EXPECT_LE(bounds.norm(), 3 / (1 - reflectance) * errors.norm()) << reflectance;
    // Half of the bounds would not hold everywhere: the check can fail.
    const Field direct = patch_error_bounds(truth, trials.emission, Field(trials.truth * 0.9));
    EXPECT_LT((0.5 * direct - 0.1 * trials.truth).minCoeff(), 0);
  }
}

TEST(PatchErrorBounds, RefuseWhatHasNone) {
  const Room room = closed_room(20, 3, 1);
  EXPECT_THROW(patch_error_bounds(RoomKernel(room), Field::Ones(20, 1), Field::Ones(20, 1)), Error);
  EXPECT_THROW(patch_error_bounds(RoomKernel(room), Field::Ones(19, 1), Field::Ones(20, 1)), UsageError);
  Room black = closed_room(20, 3, 0);
  const Field error = patch_error_bounds(RoomKernel(black), Field::Ones(20, 1), Field::Zero(20, 1));
  EXPECT_GE(error.minCoeff(), 1);
}

}  // namespace
}  // namespace radiosity::testing

#include "factorizations/lapack.hpp"
#include "foundation/error.hpp"
#include "room_operators.hpp"
#include "solvers/sampled_certificate.hpp"
#include "solvers/solver_registry.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace radiosity::testing {
namespace {

struct Lit {
  Room room;
  Eigen::MatrixXd F;
  Field emission;
  Field truth;
};

Lit lit_room(Index n, double reflectance) {
  Lit lit{chained_rooms(2, n / 2, 0.05, 12, reflectance), {}, random_lights(n, 1, 5), {}};
  lit.F = lit.room.transport(0) / reflectance;
  lit.truth = LuFactors(Eigen::MatrixXd::Identity(n, n) - lit.room.transport(0)).solve(lit.emission);
  return lit;
}

double bound_of(const Lit& lit, const Field& answer, Index rows, std::uint64_t seed) {
  return sampled_error_bound(lit.room.area, lit.room.reflectance,
                             [&](Index i) { return Eigen::VectorXd(lit.F.row(i)); }, lit.emission, answer,
                             {.rows = rows, .seed = seed})
      .absolute[0];
}

/// An answer with errors of several kinds: everywhere a little, or in few patches.
Field wrong_answer(const Lit& lit, int kind) {
  Field answer = lit.truth;
  const Field noise = random_lights(answer.rows(), 1, 40);
  if (kind == 0) answer.array() *= 1 + 1e-3 * (noise.array() - 0.5);
  if (kind == 1) answer *= 1.001;
  if (kind == 2) answer.topRows(answer.rows() / 20) *= 1.01;
  if (kind == 3) answer = answer.cast<float>().cast<double>();
  return answer;
}

TEST(SampledCertificate, HoldsAsOftenAsItSays) {
  for (const double reflectance : {0.5, 0.9}) {
    const Lit lit = lit_room(600, reflectance);
    for (int kind = 0; kind < 4; ++kind) {
      const Field answer = wrong_answer(lit, kind);
      const Eigen::VectorXd root = lit.room.root_area();
      const double error = (root.asDiagonal() * (answer - lit.truth)).norm();
      int held = 0;
      double largest = 0;
      for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const double bound = bound_of(lit, answer, 100, seed);
        held += bound >= error ? 1 : 0;
        largest = std::max(largest, bound);
      }
      EXPECT_GE(held, 198) << "kind " << kind << ", reflectance " << reflectance;
      EXPECT_LE(largest, 4 / (1 - reflectance) * error) << "kind " << kind << ", reflectance " << reflectance;
    }
  }
}

TEST(SampledCertificate, IsProvedFromAllRows) {
  const Lit lit = lit_room(60, 0.9);
  const Field answer = wrong_answer(lit, 0);
  const Eigen::VectorXd root = lit.room.root_area();
  const Field residual = lit.emission + lit.room.transport(0) * answer - answer;
  const double bound = bound_of(lit, answer, 60, 1);
  EXPECT_NEAR(bound, (root.asDiagonal() * residual).norm() / 0.1, 1e-6 * bound);
  EXPECT_GE(bound, (root.asDiagonal() * (answer - lit.truth)).norm());
  EXPECT_EQ(bound, bound_of(lit, answer, 1000, 7));
}

TEST(SampledCertificate, SaysNothingWithoutAbsorptionAndRefusesNonsense) {
  const Lit lit = lit_room(60, 0.5);
  const auto row = [&](Index i) { return Eigen::VectorXd(lit.F.row(i)); };
  const Eigen::MatrixXd white = Eigen::MatrixXd::Ones(60, 1);
  EXPECT_TRUE(
      std::isinf(sampled_error_bound(lit.room.area, white, row, lit.emission, lit.truth).absolute[0]));
  EXPECT_THROW(sampled_error_bound(lit.room.area, white, row, lit.emission, Field::Ones(59, 1)), UsageError);
  EXPECT_THROW(sampled_error_bound(lit.room.area, white, row, lit.emission, lit.truth, {.rows = 3}),
               UsageError);
  EXPECT_THROW(sampled_error_bound(lit.room.area, white, row, lit.emission, lit.truth, {.confidence = 1}),
               UsageError);
  EXPECT_THROW(sampled_error_bound(
                   lit.room.area, lit.room.reflectance, [](Index) { return Eigen::VectorXd::Ones(3).eval(); },
                   lit.emission, lit.truth),
               UsageError);
}

}  // namespace
}  // namespace radiosity::testing

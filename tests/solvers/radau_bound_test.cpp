#include "factorizations/lapack.hpp"
#include "foundation/error.hpp"
#include "room_operators.hpp"
#include "solvers/radau_bound.hpp"
#include "solvers/solver_registry.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace radiosity::testing {
namespace {

struct RadauRatios {
  double smallest = 1e300;
  double largest = 0;
  bool tight = true;
  double products = 0;
};

/// Bound over error for answers with errors of several kinds.
RadauRatios ratios_in(const Room& room, const RadauBoundOptions& options = {}) {
  const Index n = room.size(), channels = room.reflectance.cols();
  const RoomKernel truth(room);
  const Field emission = random_lights(n, channels, 3);
  Field solution(n, channels);
  for (Index c = 0; c < channels; ++c)
    solution.col(c) = LuFactors(Eigen::MatrixXd::Identity(n, n) - room.transport(c)).solve(emission.col(c));
  RadauRatios ratios;
  for (int kind = 0; kind < 5; ++kind) {
    Field answer = solution;
    const Field noise = random_lights(n, channels, 50 + static_cast<std::uint64_t>(kind));
    if (kind == 0) answer += 1e-3 * (noise.array() - 0.5).matrix();
    if (kind == 1) answer *= 1.01;
    if (kind == 2) answer.row(n / 2) *= 1.1;
    if (kind == 3) answer = answer.cast<float>().cast<double>();
    if (kind == 4) answer = emission;
    const RadauBound result = radau_error_bound(truth, emission, answer, options);
    const Eigen::RowVectorXd error = area_norms(room.root_area(), solution - answer);
    for (Index c = 0; c < channels; ++c) {
      ratios.smallest = std::min(ratios.smallest, result.bound.absolute[c] / error[c]);
      ratios.largest = std::max(ratios.largest, result.bound.absolute[c] / error[c]);
    }
    ratios.tight = ratios.tight && result.tight;
    ratios.products = std::max(ratios.products, result.products);
  }
  return ratios;
}

TEST(RadauBound, HoldsAndIsTight) {
  for (const double reflectance : {0.3, 0.7, 0.9, 0.99}) {
    for (const Room& room : {closed_room(80, 4, reflectance), sphere_cavity(60, 5, reflectance),
                             chained_rooms(3, 40, 0.05, 6, reflectance)}) {
      const RadauRatios ratios = ratios_in(room);
      EXPECT_GE(ratios.smallest, 1) << reflectance;
      EXPECT_TRUE(ratios.tight) << reflectance;
      EXPECT_LE(ratios.largest, 1.4) << reflectance;
      EXPECT_LE(ratios.products, 40) << reflectance;
    }
  }
}

TEST(RadauBound, HoldsWithBlackPatchesAndColours) {
  const RadauRatios ratios = ratios_in(open_room(120, 8, 3));
  EXPECT_GE(ratios.smallest, 1);
  EXPECT_LE(ratios.largest, 5);  // reflectances differ, and the largest stands for all
}

TEST(RadauBound, SaysWhenItIsLoose) {
  const Room room = chained_rooms(4, 30, 0.01, 6, 0.9999);
  const RadauRatios ratios = ratios_in(room, {.most_steps = 3});
  EXPECT_FALSE(ratios.tight);
  EXPECT_GE(ratios.smallest, 1);
}

TEST(RadauBound, HalfOfItWouldNotHold) {
  EXPECT_LT(0.5 * ratios_in(closed_room(80, 4, 0.9)).smallest, 1);
}

TEST(RadauBound, SaysNothingOfASingularRoomAndRefusesWrongShapes) {
  const Room room = closed_room(30, 3, 1);
  const RoomKernel truth(room);
  const RadauBound bound = radau_error_bound(truth, Field::Ones(30, 1), Field::Ones(30, 1));
  EXPECT_FALSE(bound.tight);
  EXPECT_TRUE(std::isinf(bound.bound.absolute[0]));
  EXPECT_THROW(radau_error_bound(truth, Field::Ones(29, 1), Field::Ones(30, 1)), UsageError);
  const RoomKernel nothing(Room{{}, Eigen::MatrixXd(0, 1), Eigen::MatrixXd(0, 0)});
  EXPECT_EQ(radau_error_bound(nothing, Field(0, 1), Field(0, 1)).bound.absolute[0], 0);
}

}  // namespace
}  // namespace radiosity::testing

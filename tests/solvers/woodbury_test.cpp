// Hard case W1: Woodbury's formula with condition numbers from 2e1 to 2e12.

#include "foundation/error.hpp"
#include "operators/operator_registry.hpp"
#include "room_operators.hpp"
#include "separate_spheres.hpp"
#include "solvers/woodbury.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace radiosity::testing {
namespace {

/// ||E - (I - T) B|| / (||B|| u) with the operator's own T.
double backward_error_with(const LinearOperator& transport, const Eigen::VectorXd& root_area, const Field& E,
                           const Field& B) {
  Field image(B.rows(), B.cols());
  transport.apply(B, image);
  return (area_norms(root_area, E - B + image).array() / area_norms(root_area, B).array()).maxCoeff() /
         0x1p-53;
}

TEST(Woodbury, IsBackwardStableUpToConditionTwoToTheTwelveDecades) {
  for (const int rank : {1, 64})
    for (const double condition : {2e1, 2e3, 2e6, 2e9, 2e12}) {
      const Room room = separate_spheres(rank, rank == 1 ? 100 : 4, 1 - 1 / condition);
      for (const char* norm : {"plain", "area"}) {
        const auto transport = cpu_operators().make(fmt::format("svd:k={},norm={},storage=f64", rank, norm),
                                                    form_factors_of(room));
        Woodbury solver({*transport, room.root_area(), {.tolerance = 1e-17, .max_products = 2}});
        const Field E = random_lights(room.size(), 2, 3);
        solver.start(E);
        try {
          while (!solver.converged()) solver.step();
        } catch (const Error&) {
          // Two refinements, or as far as double precision goes.
        }
        EXPECT_LE(backward_error_with(*transport, room.root_area(), E, solver.radiosity()), 100)
            << "rank " << rank << ", condition " << condition << ", norm " << norm;
      }
    }
}

TEST(Woodbury, SinglePrecisionIsWithinItsCondition) {
  for (const double condition : {2e1, 2e3, 2e5}) {
    const Room room = separate_spheres(8, 30, 1 - 1 / condition);
    const Field E = random_lights(room.size(), 1, 4);
    const auto answer = [&](const std::string& storage) {
      const auto transport = cpu_operators().make("svd:k=8,storage=" + storage, form_factors_of(room));
      Woodbury solver({*transport, room.root_area(), {.tolerance = 1e-3}});
      return Field(solve(solver, E));
    };
    const Field exact = answer("f64");
    EXPECT_LE((answer("f32") - exact).norm(), 10 * 0x1p-24 * condition * exact.norm()) << condition;
  }
}

TEST(Woodbury, SolvesColoursAtOnceAndFollowsAChangeOfThem) {
  const Room room = open_room(90, 6, 3);
  const FormFactors F = form_factors_of(room);
  const auto transport = cpu_operators().make("svd:k=90,norm=area,storage=f64", F);
  const Field E = random_lights(90, 6, 5);
  Woodbury solver({*transport, room.root_area(), {.tolerance = 1e-12}});
  const auto truth = [&](const FormFactors& factors) {
    const auto dense = cpu_operators().make("dense", factors);
    const auto lu = cpu_solvers().make("lu", {*dense, room.root_area(), {.tolerance = 1e-12}});
    return Field(solve(*lu, E));
  };
  EXPECT_LE((solve(solver, E) - truth(F)).norm(), 1e-10 * E.norm());
  Room darker = room;
  darker.reflectance *= 0.5;
  dynamic_cast<KernelOperator&>(*transport).set_reflectance(darker.reflectance);
  EXPECT_LE((solve(solver, E) - truth(form_factors_of(darker))).norm(), 1e-10 * E.norm());
}

TEST(Woodbury, RefusesASingularRoomAndWhatIsNotOfLowRank) {
  const Room room = separate_spheres(3, 20, 1);
  const auto transport = cpu_operators().make("svd:k=3,storage=f64", form_factors_of(room));
  Woodbury solver({*transport, room.root_area(), {}});
  EXPECT_THROW(solve(solver, Field::Ones(60, 1)), Error);
  const RoomKernel dense(room);
  EXPECT_THROW(Woodbury({dense, room.root_area(), {}}), UsageError);
}

}  // namespace
}  // namespace radiosity::testing

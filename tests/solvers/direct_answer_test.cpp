// Operators that answer E -> B themselves: against Woodbury's formula (hard case W1), and without a solver.

#include "foundation/error.hpp"
#include "operators/operator_registry.hpp"
#include "room_operators.hpp"
#include "separate_spheres.hpp"
#include "solvers/direct_answer.hpp"
#include "solvers/woodbury.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace radiosity::testing {
namespace {

Field answer_of(const LinearOperator& global, const Field& E) {
  DirectAnswer direct(global);
  return solve(direct, E);
}

/// With two refinements, or as many as double precision rewards.
Field woodbury_answer(const LinearOperator& transport, const Room& room, const Field& E) {
  Woodbury solver({transport, room.root_area(), {.tolerance = 1e-17, .max_products = 2}});
  solver.start(E);
  try {
    while (!solver.converged()) solver.step();
  } catch (const Error&) {
    return solver.radiosity();
  }
  return solver.radiosity();
}

TEST(DirectAnswer, IsThatOfWoodburyUpToConditionTwoToTheTwelveDecades) {
  for (const int rank : {1, 64})
    for (const double condition : {2e1, 2e3, 2e6, 2e9, 2e12}) {
      const Room room = separate_spheres(rank, rank == 1 ? 100 : 4, 1 - 1 / condition);
      const Field E = random_lights(room.size(), 2, 3);
      for (const char* norm : {"plain", "area"}) {
        const std::string spec = fmt::format("svd:k={},norm={},storage=f64", rank, norm);
        const auto transport = cpu_operators().make(spec, form_factors_of(room));
        const auto global = cpu_operators().make(spec + ",global=1", form_factors_of(room));
        const Field exact = woodbury_answer(*transport, room, E);
        EXPECT_LE((answer_of(*global, E) - exact).norm(), 10 * 0x1p-53 * condition * exact.norm())
            << "rank " << rank << ", condition " << condition << ", norm " << norm;
      }
    }
}

TEST(DirectAnswer, InSinglePrecisionIsWithinItsConditionOrKeptInDoubleOrRefused) {
  for (const double condition : {2e1, 2e3, 2e5, 2e6, 2e9, 2e12}) {
    const Room room = separate_spheres(8, 30, 1 - 1 / condition);
    const Field E = random_lights(room.size(), 1, 4);
    const auto exact_operator = cpu_operators().make("svd:k=8,storage=f64", form_factors_of(room));
    const Field exact = woodbury_answer(*exact_operator, room, E);
    std::unique_ptr<LinearOperator> global;
    try {
      global = cpu_operators().make("svd:k=8,storage=f32,global=1", form_factors_of(room));
    } catch (const Error& error) {
      EXPECT_GT(condition, 2e6) << error.what();  // rounding may have made light grow
      continue;
    }
    EXPECT_LE((answer_of(*global, E) - exact).norm(), 10 * 0x1p-24 * condition * exact.norm()) << condition;
    EXPECT_EQ(global->remark().find("float64") != std::string::npos, condition > 1e6)
        << condition << ": " << global->remark();
  }
}

TEST(DirectAnswer, IsTheDefaultOfGlobalOperatorsAlone) {
  const Room room = open_room(40, 6, 3);
  const auto global = cpu_operators().make("svd:k=8,global=1", form_factors_of(room));
  const auto solver = cpu_solvers().make("", {*global, room.root_area(), {}});
  const Field E = random_lights(40, 6, 5);
  const Field B = solve(*solver, E);
  Field expected(40, 6);
  global->apply(E, expected);
  EXPECT_EQ(B, expected);
  EXPECT_EQ(solver->products(), 0);
  EXPECT_TRUE(std::isnan(solver->residual()));
  EXPECT_EQ(solver->describe(), "");
  EXPECT_THROW(solver->start(Field::Ones(39, 3)), UsageError);
  EXPECT_THROW(solver->start(Field::Ones(40, 2)), UsageError);
  EXPECT_THROW(solver->start(Field::Constant(40, 3, std::nan(""))), UsageError);
  EXPECT_THROW(DirectAnswer(RoomKernel(room)), UsageError);
}

TEST(DirectAnswer, LeavesNothingToAnySolver) {
  const Room room = open_room(40, 6, 1);
  const SolverRegistry solvers = cpu_solvers();
  for (const char* spec : {"svd:k=8,global=1", "neumann-sparse"}) {
    const auto global = cpu_operators().make(spec, form_factors_of(room));
    for (const SolverEntry& entry : solvers.entries()) {
      try {
        solvers.make(entry.name, {*global, room.root_area(), {}});
        ADD_FAILURE() << entry.name << " takes " << spec;
      } catch (const UsageError& error) {
        EXPECT_NE(std::string(error.what()).find("leave the solver away"), std::string::npos) << error.what();
      }
    }
    EXPECT_THROW(Woodbury({*global, room.root_area(), {}}), UsageError) << "made without a registry";
  }
}

}  // namespace
}  // namespace radiosity::testing

#include "foundation/error.hpp"
#include "operators/operator_registry.hpp"
#include "room_operators.hpp"
#include "solvers/solver_registry.hpp"

#include <gtest/gtest.h>

namespace radiosity::testing {
namespace {

struct Answer {
  int products = 0;
  Field radiosity;
};

Answer answer_of(const Room& room, const std::string& spec, const Field& emission, double tolerance = 1e-6) {
  const FormFactors F = form_factors_of(room);
  const auto truth = cpu_operators().make("dense", F);
  SolverProblem problem{*truth, room.root_area(), {.tolerance = tolerance}};
  problem.make_operator = [&](const std::string& other) { return cpu_operators().make(other, F); };
  const auto solver = cpu_solvers().make(spec, problem);
  Answer result;
  result.radiosity = solve(*solver, emission);
  result.products = solver->products();
  return result;
}

TEST(CorrectedConjugateGradients, AFewTrueProductsGiveExactAnswers) {
  for (const int rooms : {1, 2, 5, 10}) {
    const Room chain = chained_rooms(rooms, 20, 0.02, 3, 0.9999);
    const Field E = random_lights(chain.size(), 4, 5);
    const Answer plain = answer_of(chain, "cg", E, 1e-10);
    for (const char* other : {"dense:f16", "dense:f16,closure=symmetric", "dense:f16,closure=blocks"}) {
      const Answer corrected = answer_of(chain, std::string("cg:preconditioner=") + other, E);
      EXPECT_LE(corrected.products, 8) << rooms << " rooms, " << other;
      EXPECT_LT(corrected.products, plain.products);
      EXPECT_LT((corrected.radiosity - plain.radiosity).norm(), 1e-4 * plain.radiosity.norm()) << other;
    }
  }
}

TEST(CorrectedConjugateGradients, ColoursAndBlackPatchesToo) {
  const Room room = open_room(67, 2, 3);
  const Field E = random_lights(67, 6, 3);
  const Answer corrected = answer_of(room, "cg:preconditioner=dense:f16", E, 1e-10);
  EXPECT_LT((corrected.radiosity - answer_of(room, "cg", E, 1e-12).radiosity).norm(), 1e-9 * E.norm());
}

TEST(CorrectedConjugateGradients, RefusesWhatItCannotUse) {
  const Room room = closed_room(10, 1, 0.5);
  EXPECT_THROW(answer_of(room, "cg:preconditioner=dense:closure=rows", Field::Ones(10, 1)), UsageError);
  EXPECT_THROW(answer_of(room, "cg:preconditioner=nothing", Field::Ones(10, 1)), UsageError);
  EXPECT_THROW(answer_of(room, "cg:preconditioner", Field::Ones(10, 1)), UsageError);
  const RoomKernel kernel(room);
  EXPECT_THROW(cpu_solvers().make("cg:preconditioner=dense", {kernel, room.root_area(), {}}), UsageError);
}

}  // namespace
}  // namespace radiosity::testing

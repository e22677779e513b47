#include "foundation/parallel.hpp"
#include "operators/operator_registry.hpp"
#include "room_operators.hpp"
#include "solvers/solver_registry.hpp"

#include <gtest/gtest.h>

namespace radiosity::testing {
namespace {

/// A T read from the wrong side; the check on agreement must notice.
class TransposedRoom final : public LinearOperator {
 public:
  explicit TransposedRoom(const Room& room) : matrix_(room.transport(0).transpose()) {}
  Index size() const override { return matrix_.rows(); }
  Index channels() const override { return 1; }
  ByteCount bytes() const override { return {}; }
  std::string describe() const override { return "transposed"; }

 private:
  void apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const override {
    const Eigen::MatrixXd image = alpha * (matrix_ * X);
    Y = beta == 0 ? image : Eigen::MatrixXd(image + beta * Y);
  }
  Eigen::MatrixXd matrix_;
};

Field direct_answer(const Room& room, const Field& emission) {
  Field radiosity(emission.rows(), emission.cols());
  for (Index j = 0; j < emission.cols(); ++j) {
    // The plain oracle: a thousand bounces summed with the explicit matrix, then polished by its own
    // residual.
    const Eigen::MatrixXd T = room.transport(j % room.reflectance.cols());
    Eigen::VectorXd sum = emission.col(j);
    for (int bounce = 0; bounce < 3000; ++bounce) sum = (emission.col(j) + T * sum).eval();
    radiosity.col(j) = sum;
  }
  return radiosity;
}

double largest_relative_difference(const Room& room, const Field& B, const Field& reference) {
  const Eigen::RowVectorXd difference = area_norms(room.root_area(), Field(B - reference));
  return difference.cwiseQuotient(area_norms(room.root_area(), reference)).maxCoeff();
}

Room closed_room_of_colours(Index n, std::uint64_t seed) {
  Room room = closed_room(n, seed, 0.9);
  Eigen::MatrixXd colours(n, 3);
  colours << Eigen::VectorXd::Constant(n, 0.9), Eigen::VectorXd::Constant(n, 0.5), Eigen::VectorXd::Zero(n);
  room.reflectance = colours;
  return room;
}

TEST(SolverAgreement, EverySolverMeetsTheBounceSum) {
  const std::vector<Room> rooms = {open_room(60, 1, 1), open_room(67, 2, 3), closed_room_of_colours(48, 3),
                                   sphere_cavity(33, 4, 0.8)};
  for (const Room& room : rooms) {
    const Index channels = room.reflectance.cols();
    const Field E = random_lights(room.size(), 4 * channels, 9);
    const Field reference = direct_answer(room, E);
    const RoomKernel kernel(room);
    const RoomTransport plain(room);
    for (const LinearOperator* transport :
         {static_cast<const LinearOperator*>(&kernel), static_cast<const LinearOperator*>(&plain)}) {
      for (const std::string& spec : all_solvers()) {
        if (spec == "cg" && !transport->symmetric()) continue;
        const auto solver = cpu_solvers().make(spec, {*transport, room.root_area(), {.tolerance = 1e-12}});
        const Field& B = solve(*solver, E);
        EXPECT_LE(largest_relative_difference(room, B, reference), 3e-11)
            << spec << " on " << transport->describe();
        EXPECT_LE(solver->residual(), 1e-12) << spec;
      }
    }
  }
}

TEST(SolverAgreement, ATransposedOperatorIsNoticed) {
  const Room room = open_room(60, 1, 1);
  const Field E = random_lights(room.size(), 2, 9);
  const TransposedRoom broken(room);
  const auto solver = cpu_solvers().make("gmres", {broken, room.root_area(), {.tolerance = 1e-12}});
  EXPECT_GT(largest_relative_difference(room, solve(*solver, E), direct_answer(room, E)), 1e-3);
}

TEST(SolverAgreement, SteppingByHandEqualsSolve) {
  const Room room = open_room(50, 7, 3);
  const RoomKernel transport(room);
  const Field E = random_lights(room.size(), 6, 2);
  for (const std::string& spec : all_solvers()) {
    const SolverProblem problem{transport, room.root_area(), {}};
    const auto whole = cpu_solvers().make(spec, problem);
    const Field B = solve(*whole, E);
    const auto stepped = cpu_solvers().make(spec, problem);
    stepped->start(E);
    while (!stepped->converged()) {
      ASSERT_EQ(stepped->radiosity().rows(), E.rows());
      ASSERT_TRUE(stepped->radiosity().allFinite()) << spec;
      stepped->step();
    }
    EXPECT_EQ(stepped->radiosity(), B) << spec;
    EXPECT_EQ(stepped->products(), whole->products()) << spec;
    stepped->step();  // after the end a step changes nothing
    EXPECT_EQ(stepped->radiosity(), B) << spec;
    EXPECT_EQ(solve(*whole, E), B) << spec << " started again";
  }
}

TEST(SolverAgreement, ConvergedColumnsDoNotDisturbTheOthers) {
  const Room room = closed_room(64, 5, 0.95);
  const RoomKernel transport(room);
  Field E = random_lights(room.size(), 3, 2);
  E.col(0).setZero();
  E.col(1).setOnes();  // an eigenvector: done after two products
  for (const std::string& spec : all_solvers()) {
    const SolverProblem problem{transport, room.root_area(), {.tolerance = 1e-10}};
    const auto together = cpu_solvers().make(spec, problem);
    const auto alone = cpu_solvers().make(spec, problem);
    const Field B = solve(*together, E);
    const Field last = solve(*alone, E.rightCols(1));
    EXPECT_EQ(B.col(0), E.col(0)) << spec;
    EXPECT_LE((B.col(2) - last).norm(), 1e-13 * last.norm()) << spec;
  }
}

TEST(SolverAgreement, BitwiseTheSameForAnyNumberOfThreads) {
  const Room room = open_room(150, 11, 3);
  const FormFactors form_factors = form_factors_of(room);
  const Field E = random_lights(room.size(), 9, 4);
  for (const std::string& spec : all_solvers()) {
    std::optional<Field> first;
    for (const int threads : {1, 2, 8}) {
      const ThreadLimit limit(threads);
      const auto transport = cpu_operators().make("dense", form_factors);
      const auto solver = cpu_solvers().make(spec, {*transport, room.root_area(), {}});
      const Field B = solve(*solver, E);
      if (!first) first = B;
      EXPECT_EQ(B, *first) << spec << " with " << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace radiosity::testing

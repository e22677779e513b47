// Hard case R1: reflectances up to 1 in a closed room.

#include "foundation/error.hpp"
#include "operators/operator_registry.hpp"
#include "room_operators.hpp"
#include "solvers/solver_registry.hpp"
#include "solvers/stepped_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace radiosity::testing {
namespace {

const std::vector<double> distances_to_one = {1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12};

/// ||E - (I - T) B|| / (||I - T|| ||B|| u) in the area norm, largest over the columns. ||I - T|| >= 1 is
/// taken as 1, which is the strict side.
double backward_error(const Room& room, const Field& B, const Field& E) {
  const Field residual = E - B + room.transport(0) * B;
  const Eigen::RowVectorXd norms = area_norms(room.root_area(), residual);
  return norms.cwiseQuotient(area_norms(room.root_area(), B)).maxCoeff() / double_roundoff;
}

/// Runs until the solver converges or says that rounding lets it go no further; returns B.
Field as_far_as_possible(Solver& solver, const Field& E) {
  try {
    return solve(solver, E);
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("double precision"), std::string::npos) << error.what();
    return solver.radiosity();
  }
}

TEST(NearlySingular, KrylovSolversAreBackwardStable) {
  for (const double distance : distances_to_one) {
    for (const Room& room : {closed_room(96, 3, 1 - distance), sphere_cavity(64, 5, 1 - distance)}) {
      const RoomKernel transport(room);
      Field E = random_lights(room.size(), 3, 8);
      E.col(1) = Eigen::VectorXd::Unit(room.size(), 4);
      for (const std::string spec : {"cg", "gmres", "lu"}) {
        const auto solver = cpu_solvers().make(spec, {transport, room.root_area(), {.tolerance = 1e-17}});
        EXPECT_LE(backward_error(room, as_far_as_possible(*solver, E), E), 30)
            << spec << " at 1 - reflectance = " << distance;
      }
    }
  }
}

TEST(NearlySingular, TheCheckNoticesSinglePrecision) {
  const Room room = closed_room(96, 3, 0.99);
  const RoomKernel transport(room);
  const Field E = random_lights(room.size(), 1, 8);
  const auto solver = cpu_solvers().make("cg", {transport, room.root_area(), {.tolerance = 1e-13}});
  const Field rounded = solve(*solver, E).cast<float>().cast<double>();
  EXPECT_GT(backward_error(room, rounded, E), 30);
}

/// ceil(ln(tolerance / c1) / ln rho), c1 the part of E along the dominant eigenvector (the constant) in the
/// area norm.
double neumann_count(const Room& room, const Eigen::VectorXd& E, double reflectance, double tolerance) {
  const double along = std::abs(room.area.dot(E)) / std::sqrt(room.area.sum());
  const double c1 = along / std::sqrt(room.area.dot(E.cwiseAbs2()));
  return std::ceil(std::log(tolerance / c1) / std::log(reflectance));
}

TEST(NearlySingular, NeumannTakesTheStepsThatTheReflectanceDictates) {
  for (const double reflectance : {0.5, 0.8, 0.9, 0.99, 0.999}) {
    const Room room = closed_room(64, 3, reflectance);
    const RoomKernel transport(room);
    Field lights = random_lights(room.size(), 3, 8);
    lights.col(0).setOnes();
    lights.col(1) = Eigen::VectorXd::Unit(room.size(), 4);
    for (Index j = 0; j < lights.cols(); ++j) {
      const auto solver = cpu_solvers().make("neumann", {transport, room.root_area(), {}});
      solve(*solver, lights.col(j));
      EXPECT_NEAR(solver->products(), neumann_count(room, lights.col(j), reflectance, 1e-6), 2)
          << "light " << j << ", reflectance " << reflectance;
    }
  }
}

TEST(NearlySingular, CountingUpdatesInsteadOfResidualsIsNoticed) {
  // Stopping on ||B_k+1 - B_k|| <= tolerance ||B_k|| is the mistake: it ends ln(1 - rho) / ln(rho) steps
  // early.
  const double reflectance = 0.99;
  const Room room = closed_room(64, 3, reflectance);
  const Eigen::MatrixXd T = room.transport(0);
  const Eigen::VectorXd E = Eigen::VectorXd::Ones(room.size());
  Eigen::VectorXd B = E;
  int steps = 0;
  for (double update = 1; update > 1e-6; ++steps) {
    const Eigen::VectorXd next = E + T * B;
    update = (next - B).norm() / B.norm();
    B = next;
  }
  EXPECT_GT(std::abs(steps - neumann_count(room, E, reflectance, 1e-6)), 2);
}

TEST(NearlySingular, StationarySolversRefuseWhatTheirBudgetCannotReach) {
  const Room room = closed_room(64, 3, 1 - 1e-8);
  const RoomKernel transport(room);
  for (const std::string spec : {"neumann", "gauss-seidel"}) {
    const auto solver = cpu_solvers().make(spec, {transport, room.root_area(), {}});
    try {
      solve(*solver, Field::Ones(room.size(), 1));
      FAIL() << spec << " took 1e9 products";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("budget"), std::string::npos) << error.what();
    }
    EXPECT_LE(solver->products(), 150) << spec;
  }
}

TEST(NearlySingular, AClosedRoomWithoutAbsorptionIsSaidToBeSingular) {
  for (const Room& room : {closed_room(96, 3, 1), sphere_cavity(64, 5, 1)}) {
    const RoomKernel kernel(room);
    const RoomTransport plain(room);
    for (const std::string spec : {"cg", "gmres", "gmres:restart=3", "neumann", "gauss-seidel", "lu"}) {
      for (const bool symmetric : {true, false}) {
        if (spec == "cg" && !symmetric) continue;
        const LinearOperator& transport = symmetric ? static_cast<const LinearOperator&>(kernel) : plain;
        for (const Field& E : {Field(Field::Ones(room.size(), 1)), Field(random_lights(room.size(), 2, 5))}) {
          const auto solver = cpu_solvers().make(spec, {transport, room.root_area(), {}});
          try {
            solve(*solver, E);
            ADD_FAILURE() << spec << " solved a singular system";
          } catch (const UsageError& error) {
            ADD_FAILURE() << error.what();
          } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("singular"), std::string::npos) << error.what();
            EXPECT_LE(solver->products(), 2000) << spec;
          }
        }
      }
    }
  }
}

TEST(NearlySingular, ErrorsInFormFactorsDoNotHideIt) {
  // Rows that sum to 1 - 1e-9: the system can be solved, and the answer is 1e9 times nonsense.
  Room room = closed_room(96, 3, 1);
  room.kernel *= 1 - 1e-9;
  const RoomKernel transport(room);
  for (const std::string spec : {"cg", "gmres", "neumann", "gauss-seidel", "lu"}) {
    try {
      solve(*cpu_solvers().make(spec, {transport, room.root_area(), {}}), Field::Ones(room.size(), 1));
      ADD_FAILURE() << spec << " answered";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("singular"), std::string::npos) << error.what();
    }
  }
  room.reflectance(5, 0) = 0.5;  // a single patch that absorbs, and there is an answer
  const RoomKernel absorbing(room);
  const auto solver = cpu_solvers().make("cg", {absorbing, room.root_area(), {}});
  EXPECT_LE(solve(*solver, Field::Ones(room.size(), 1)).maxCoeff(), 1e4);
}

TEST(NearlySingular, SinglePrecisionEndsWhereItsRoundingLetsIt) {
  const Room room = closed_room(60, 4, 0.9999);
  const FormFactors F = form_factors_of(room);
  const Field E = random_lights(60, 2, 3);
  const RoomKernel truth(room);
  const Field reference =
      solve(*cpu_solvers().make("cg", {truth, room.root_area(), {.tolerance = 1e-12}}), E);
  for (const char* stored : {"dense:f32", "dense:f16,closure=symmetric"}) {
    const auto transport = cpu_operators().make(stored, F);
    const auto solver = cpu_solvers().make("cg", {*transport, room.root_area(), {.tolerance = 1e-10}});
    const Field B = solve(*solver, E);
    EXPECT_GT(solver->residual(), 1e-10) << stored;  // and it does not claim more
    EXPECT_LE(solver->products(), 20) << stored;     // nor spend many products on finding out
    EXPECT_LT((B - reference).norm(), 0.05 * reference.norm()) << stored;
  }
}

}  // namespace
}  // namespace radiosity::testing

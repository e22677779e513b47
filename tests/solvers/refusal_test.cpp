// What solvers do not accept, and that they say so.

#include "foundation/error.hpp"
#include "room_operators.hpp"
#include "solvers/solver_registry.hpp"
#include "solvers/spectral_radius.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace radiosity::testing {
namespace {

std::string refusal(const std::string& spec, const LinearOperator& transport, const Room& room,
                    const Field& E, const SolverOptions& options = {}) {
  try {
    const auto solver = cpu_solvers().make(spec, {transport, room.root_area(), options});
    solve(*solver, E);
  } catch (const UsageError& error) {
    return std::string("usage: ") + error.what();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Refusal, EmissionsThatAreNotFiniteOrOfTheWrongShape) {
  const Room room = open_room(20, 1, 3);
  const RoomKernel transport(room);
  for (const std::string& spec : all_solvers()) {
    Field E = Field::Ones(20, 3);
    E(7, 2) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(contains(refusal(spec, transport, room, E), "patch 7, column 2")) << spec;
    E(7, 2) = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(contains(refusal(spec, transport, room, E), "usage:")) << spec;
    EXPECT_TRUE(contains(refusal(spec, transport, room, Field::Ones(20, 4)), "3 channels")) << spec;
    EXPECT_TRUE(contains(refusal(spec, transport, room, Field::Ones(19, 3)), "19 rows")) << spec;
  }
}

TEST(Refusal, NamesKeysAndOptions) {
  const Room room = open_room(20, 1, 1);
  const RoomKernel kernel(room);
  const RoomTransport plain(room);
  const Field E = Field::Ones(20, 1);
  EXPECT_TRUE(contains(refusal("jacobi", kernel, room, E), "gauss-seidel"));
  EXPECT_TRUE(contains(refusal("cg:restart=3", kernel, room, E), "restart"));
  EXPECT_TRUE(contains(refusal("gmres:restart=0", kernel, room, E), "restart"));
  EXPECT_TRUE(contains(refusal("cg", plain, room, E), "usage: cg needs a symmetric kernel"));
  EXPECT_TRUE(contains(refusal("cg", kernel, room, E, {.tolerance = 0}), "tolerance"));
  EXPECT_TRUE(contains(refusal("cg", kernel, room, E, {.max_products = 0}), "budget"));
  EXPECT_EQ(cpu_solvers().make("", {kernel, room.root_area(), {}})->describe(), "cg");
  EXPECT_EQ(cpu_solvers().make("", {plain, room.root_area(), {}})->describe(), "gmres:restart=30");
  SolverRegistry registry = cpu_solvers();
  EXPECT_THROW(registry.add({"cg", "", "", nullptr}), UsageError);
}

TEST(Refusal, ABudgetThatIsTooSmallNamesTheResidualReached) {
  const Room room = closed_room(60, 2, 0.95);
  const RoomKernel transport(room);
  const Field E = random_lights(60, 1, 1);
  for (const std::string spec : {"cg", "gmres", "neumann", "gauss-seidel"})
    EXPECT_TRUE(
        contains(refusal(spec, transport, room, E, {.tolerance = 1e-10, .max_products = 5}), "budget"))
        << spec;
}

TEST(Refusal, EntriesThatDoNotFit) {
  const Room room = open_room(60, 2, 1);
  const RoomKernel transport(room);
  const SolverOptions options{.matrix_bytes = 60 * 60 * 8 - 1};
  for (const std::string spec : {"gauss-seidel", "lu"})
    EXPECT_TRUE(contains(refusal(spec, transport, room, Field::Ones(60, 1), options), "60 patches")) << spec;
}

TEST(Refusal, RowSumsAboveOne) {
  Room room = closed_room(60, 2, 0.99);
  room.kernel *= 1.05;
  const RoomKernel transport(room);
  const Field E = random_lights(60, 1, 1);
  for (const std::string& spec : all_solvers())
    EXPECT_TRUE(contains(refusal(spec, transport, room, E), "grow at every bounce")) << spec;
  // In one of two rooms alone: found by the iteration itself.
  room = chained_rooms(2, 30, 1e-6, 2, 0.9);
  room.kernel.topLeftCorner(30, 30) *= 1.2;
  const RoomKernel partly(room);
  EXPECT_TRUE(contains(refusal("cg", partly, room, E), "not positive"));
  EXPECT_TRUE(contains(refusal("neumann", partly, room, E), "above 1"));
  EXPECT_TRUE(contains(refusal("gauss-seidel", partly, room, E), "above 1"));
}

TEST(Refusal, SignedOperatorsHaveNoBound) {
  Room room = closed_room(60, 2, 0.5);
  room.kernel.row(3) *= -1;
  room.kernel.col(3) *= -1;
  const RoomTransport transport(room);
  EXPECT_FALSE(bound_spectral_radius(transport).upper.has_value());
  EXPECT_TRUE(contains(refusal("neumann", transport, room, Field::Ones(60, 1)), "negative"));
  EXPECT_EQ(refusal("gmres", transport, room, Field::Ones(60, 1)), "");
}

TEST(Refusal, NothingToDoIsNoError) {
  for (const Index n : {0, 1, 2}) {
    Room room = sphere_cavity(n, 1, 0.5);
    room.reflectance = Eigen::MatrixXd::Constant(n, 3, 0.5);
    const RoomKernel transport(room);
    for (const std::string& spec : all_solvers()) {
      const auto solver = cpu_solvers().make(spec, {transport, room.root_area(), {}});
      const std::uint64_t used = transport.usage().products;
      EXPECT_EQ(solve(*solver, Field::Zero(n, 6)), Field::Zero(n, 6)) << spec;
      EXPECT_EQ(solver->products(), 0) << spec << ", n = " << n;
      EXPECT_EQ(transport.usage().products, used) << spec << ": a product for the sake of no light";
      EXPECT_EQ(solve(*solver, Field(n, 0)).cols(), 0) << spec;
      EXPECT_EQ(solver->products(), 0) << spec;
      EXPECT_LE(solve(*solver, Field::Ones(n, 3)).cols(), 3) << spec;
    }
  }
}

}  // namespace
}  // namespace radiosity::testing

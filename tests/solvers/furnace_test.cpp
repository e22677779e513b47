// Hard case E1: in a closed room with one reflectance and uniform emission, B = E / (1 - rho).

#include "foundation/error.hpp"
#include "room_operators.hpp"
#include "solvers/solver_registry.hpp"
#include "solvers/stepped_solver.hpp"

#include <gtest/gtest.h>

namespace radiosity::testing {
namespace {

double largest_error(const Field& B, double reflectance) {
  const double exact = 2.5 / (1 - reflectance);
  return (B.array() - exact).abs().maxCoeff() / exact;
}

double allowed_error(Index n, double reflectance) {
  return 30 * double_roundoff * static_cast<double>(n) / (1 - reflectance);
}

TEST(Furnace, EverySolverGivesEmissionOverAbsorption) {
  for (const double reflectance : {0.0, 0.1, 0.5, 0.9, 0.99}) {
    for (const Room& room : {closed_room(72, 13, reflectance), sphere_cavity(72, 14, reflectance)}) {
      const RoomKernel transport(room);
      const Field E = Field::Constant(room.size(), 1, 2.5);
      for (const std::string spec : {"cg", "gmres", "neumann", "gauss-seidel", "lu"}) {
        // The residual that leaves an error of the allowed size; lower ones are below rounding at 0.99.
        const double tolerance = 10 * double_roundoff * static_cast<double>(room.size());
        const auto solver = cpu_solvers().make(spec, {transport, room.root_area(), {.tolerance = tolerance}});
        EXPECT_LE(largest_error(solve(*solver, E), reflectance), allowed_error(room.size(), reflectance))
            << spec << " at reflectance " << reflectance;
      }
    }
  }
}

TEST(Furnace, AMissingBounceIsNoticed) {
  // Row sums one part in 10^11 short of 1: light that leaks.
  Room room = closed_room(72, 13, 0.9);
  room.kernel *= 1 - 1e-11;
  const RoomKernel transport(room);
  const auto solver = cpu_solvers().make("cg", {transport, room.root_area(), {.tolerance = 1e-14}});
  const Field& B = solve(*solver, Field::Constant(room.size(), 1, 2.5));
  EXPECT_GT(largest_error(B, 0.9), allowed_error(room.size(), 0.9));
}

}  // namespace
}  // namespace radiosity::testing

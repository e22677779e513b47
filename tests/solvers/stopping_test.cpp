// Hard case R4: solvers stop on the residual, and the residual bounds the error.

#include "room_operators.hpp"
#include "solvers/solver_registry.hpp"

#include <gtest/gtest.h>

namespace radiosity::testing {
namespace {

/// The mistake: stops when B changes little, and calls the change its residual.
class StopsOnTheUpdate final : public Solver {
 public:
  StopsOnTheUpdate(const LinearOperator& transport, double tolerance)
      : transport_(transport), tolerance_(tolerance) {}
  void start(const Field& emission) override { emission_ = radiosity_ = emission; }
  void step() override {
    Field next(emission_.rows(), emission_.cols());
    transport_.apply(radiosity_, next);
    next += emission_;
    update_ = (next - radiosity_).norm() / next.norm();
    radiosity_ = next;
  }
  bool converged() const override { return update_ <= tolerance_; }
  const Field& radiosity() const override { return radiosity_; }
  double residual() const override { return update_; }
  int products() const override { return 0; }
  std::string describe() const override { return "stops-on-the-update"; }

 private:
  const LinearOperator& transport_;
  double tolerance_;
  Field emission_;
  Field radiosity_;
  double update_ = 1;
};

struct Verdict {
  double claimed;         ///< the solver's relative residual
  double computed;        ///< the same from the explicit matrix
  double error;           ///< ||B - B_exact||_A
  double residual_bound;  ///< ||residual||_A / (1 - ||T||_A)
  double rounding;        ///< of the judge's own residual, ||.||_A
  double emission;        ///< ||E||_A
  double absorption;      ///< 1 - ||T||_A

  bool passes(double tolerance) const {
    return computed <= tolerance + rounding / emission && computed <= 1.01 * claimed + rounding / emission &&
           error <= residual_bound * (1 + 1e-9) + rounding / absorption;
  }
};

/// With one reflectance ||T||_A = rho ||K||_2 <= rho, and B = E / (1 - rho) is known for uniform E; the other
/// light is chosen so that the answer is known too: B random, E = (I - T) B.
Verdict judge(Solver& solver, const Room& room, double reflectance, const Field& B_exact) {
  const Eigen::MatrixXd T = room.transport(0);
  const Field E = B_exact - T * B_exact;
  const Field& B = solve(solver, E);
  const double residual = area_norms(room.root_area(), Field(E - B + T * B))[0];
  const double error = area_norms(room.root_area(), Field(B - B_exact))[0];
  const double emission = area_norms(room.root_area(), E)[0];
  const double rounding = 1e-15 * area_norms(room.root_area(), B)[0];
  const double absorption = 1 - reflectance;
  return {solver.residual(), residual / emission, error, residual / absorption, rounding,
          emission,          absorption};
}

TEST(Stopping, TheResidualIsTheTrueOneAndBoundsTheError) {
  for (const double reflectance : {0.5, 0.9, 0.99}) {
    const Room room = closed_room(80, 21, reflectance);
    const RoomKernel transport(room);
    for (const Field& B :
         {Field(Field::Ones(80, 1)), Field(random_lights(80, 1, 3)), Field(Eigen::VectorXd::Unit(80, 7))})
      for (const std::string spec : {"cg", "gmres", "gmres:restart=4", "neumann", "gauss-seidel", "lu"})
        for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
          const auto solver =
              cpu_solvers().make(spec, {transport, room.root_area(), {.tolerance = tolerance}});
          const Verdict verdict = judge(*solver, room, reflectance, B);
          EXPECT_TRUE(verdict.passes(tolerance))
              << spec << " at " << tolerance << ": claimed " << verdict.claimed << ", computed "
              << verdict.computed << ", error " << verdict.error << " where " << verdict.residual_bound
              << " is allowed";
        }
  }
}

TEST(Stopping, ASolverThatStopsOnTheUpdateFailsTheCheck) {
  const Room room = closed_room(80, 21, 0.99);
  const RoomKernel transport(room);
  StopsOnTheUpdate broken(transport, 1e-6);
  EXPECT_FALSE(judge(broken, room, 0.99, Field::Ones(80, 1)).passes(1e-6));
}

}  // namespace
}  // namespace radiosity::testing

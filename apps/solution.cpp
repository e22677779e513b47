#include "apps/solution.hpp"

#include "foundation/memory.hpp"
#include "foundation/stopwatch.hpp"
#include "operators/irradiance.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace radiosity {
namespace {

/// How far a relative residual has come from 1 to the tolerance, on a logarithmic scale.
double progress(double residual, double tolerance) {
  if (residual <= tolerance) return 1;
  return std::clamp(std::log(residual) / std::log(tolerance), 0.0, 1.0);
}

}  // namespace

Solution solve_scene(const FormFactors& form_factors, const Field& emission, const SolutionRequest& request,
                     const Program& program, Monitor& monitor) {
  Solution result;
  const Stopwatch building;
  const std::unique_ptr<LinearOperator> transport =
      program.operators.make(request.operator_spec, form_factors);
  release_freed_memory();  // what building took, before the solver's fields come on top
  result.build_seconds = building.seconds();
  result.operator_name = transport->describe();
  result.bytes = transport->bytes().total();

  SolverOptions options;
  options.tolerance = request.tolerance;
  const Stopwatch solving;
  std::unique_ptr<Solver> solver = program.solvers.make(
      request.solver_spec,
      {*transport, form_factors.mesh->area.cwiseSqrt(), options,
       [&](const std::string& spec) { return program.operators.make(spec, form_factors); }});
  solver->start(emission);
  while (!solver->converged()) {
    solver->step();
    monitor.checkpoint("solving", progress(solver->residual(), request.tolerance));
  }
  result.solve_seconds = solving.seconds();
  result.solver_name = solver->describe();
  result.products = solver->products();
  result.residual = solver->residual();
  result.device = transport->device_use();
  result.radiosity = solver->radiosity();
  solver.reset();  // with fields of its own, each as long as the next
  result.irradiance = irradiance(form_factors, *transport, result.radiosity);
  return result;
}

}  // namespace radiosity

#include "experiments/reference_solution.hpp"

#include "foundation/error.hpp"
#include "operators/operator_registry.hpp"
#include "solvers/solver_registry.hpp"

namespace radiosity {

std::optional<Field> reference_solution(const FormFactors& form_factors, const Field& emission) {
  const auto transport = cpu_operators().make("dense:f64", form_factors);
  const SolverProblem problem{*transport, form_factors.mesh->area.cwiseSqrt(), {.tolerance = 1e-12}};
  for (const char* spec : {"cg", "gmres:restart=100", "lu"}) {
    if (std::string(spec) == "cg" && !transport->symmetric()) continue;
    try {
      const auto solver = cpu_solvers().make(spec, problem);
      return solve(*solver, emission);
    } catch (const Cancelled&) {
      throw;
    } catch (const UsageError&) {
      throw;
    } catch (const Error&) {
      // A refusal: the next solver asks for less of the system.
    }
  }
  return std::nullopt;
}

std::vector<double> relative_errors(const PatchMesh& mesh, const Field& X, const Field& reference) {
  const Eigen::VectorXd root_area = mesh.area.cwiseSqrt();
  std::vector<double> errors;
  for (Index first = 0; first < X.cols(); first += mesh.channels()) {
    const auto truth = reference.middleCols(first, mesh.channels());
    const double size = (root_area.asDiagonal() * truth).norm();
    const double difference =
        (root_area.asDiagonal() * (X.middleCols(first, mesh.channels()) - truth)).norm();
    if (size > 0) errors.push_back(difference / size);
    if (size == 0 && difference == 0) errors.push_back(0);
  }
  return errors;
}

}  // namespace radiosity

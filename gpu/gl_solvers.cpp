#include "gpu/gl_solvers.hpp"

#include "gpu/device_solver.hpp"

#include <utility>

namespace radiosity {
namespace {

std::unique_ptr<Solver> make_on_device(const std::string& name, const SolverProblem& problem) {
  if (name == "cg") return std::make_unique<DeviceConjugateGradients>(problem);
  return std::make_unique<DeviceNeumann>(problem);
}

/// Whether fields are to stay on the device, by what a spec says.
bool take_fields(Spec& spec, const LinearOperator& transport) {
  const std::string fields = spec.choice("fields", "auto", {"auto", "device", "cpu"});
  if (fields != "auto") return fields == "device";
  const bool preconditioned = spec.name() == "cg" && !spec.rest("preconditioner").empty();
  return !preconditioned && solvable_on_device(transport);
}

}  // namespace

SolverRegistry gl_solvers(const SolverRegistry& cpu) {
  SolverRegistry registry;
  for (SolverEntry entry : cpu.entries()) {
    if (entry.name == "cg" || entry.name == "neumann") {
      entry.summary += "; fields=device iterates there";
      entry.make = [on_cpu = entry.make](Spec& spec, const SolverProblem& problem) {
        return take_fields(spec, problem.transport) ? make_on_device(spec.name(), problem)
                                                    : on_cpu(spec, problem);
      };
    }
    registry.add(std::move(entry));
  }
  return registry;
}

}  // namespace radiosity

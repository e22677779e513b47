#pragma once

#include "solvers/solver_registry.hpp"

namespace radiosity {

/// The solvers of `cpu` for operators on a device. cg and neumann have a further key,
/// `fields=auto|device|cpu`: where the fields that they iterate on are (DeviceSolver). auto: on the device
/// where the operator has a form for that, which closed ones have not, and no preconditioner is asked for.
/// The others iterate on the CPU and multiply on the device.
SolverRegistry gl_solvers(const SolverRegistry& cpu);

}  // namespace radiosity

#pragma once

#include "apps/program.hpp"
#include "form_factors/form_factors.hpp"

#include <cstddef>
#include <optional>
#include <string>

namespace radiosity {

/// Which operator and solver, and how exactly.
struct SolutionRequest {
  std::string operator_spec = "dense";
  std::string solver_spec;  ///< empty: the registry's default
  double tolerance = 1e-6;  ///< relative residual
};

/// B of a scene and what it took.
struct Solution {
  Field radiosity;   ///< n x channels, W/m^2
  Field irradiance;  ///< the same, F B
  std::string operator_name;
  std::string solver_name;          ///< empty where the operator answers by itself
  std::size_t bytes = 0;            ///< of the operator
  std::optional<DeviceUse> device;  ///< empty: the CPU
  double build_seconds = 0;
  double solve_seconds = 0;
  int products = 0;
  double residual = 0;  ///< NaN where the operator answers by itself
};

/// Builds the operator and steps the solver to its end; `monitor` may cancel between steps.
Solution solve_scene(const FormFactors& form_factors, const Field& emission, const SolutionRequest& request,
                     const Program& program, Monitor& monitor);

}  // namespace radiosity

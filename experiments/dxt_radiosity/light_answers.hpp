#pragma once

#include "experiments/lights.hpp"
#include "form_factors/form_factors.hpp"
#include "foundation/monitor.hpp"
#include "operators/operator_registry.hpp"
#include "solvers/solver_registry.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// Mean relative errors of B and of B - E over lights, in the area norm.
struct AnswerErrors {
  double radiosity = 0;
  double indirect = 0;
};

AnswerErrors answer_errors(const PatchMesh& mesh, const Field& emission, const Field& radiosity,
                           const Field& reference);

/// Lights and what they really do, for answers of many operators.
struct LitScene {
  FormFactors form_factors;
  Field emission;   ///< n x (lights * channels)
  Field reference;  ///< all bounces, in double

  const PatchMesh& mesh() const { return *form_factors.mesh; }
};

/// Throws Error where the reference does not exist.
LitScene lit_scene(FormFactors form_factors, const LightCounts& lights, std::uint64_t seed, Monitor& monitor);

/// The same F with one reflectance for all patches and channels: as many matrices as before.
FormFactors with_even_reflectance(const FormFactors& form_factors, double reflectance);

/// E, T E + E, ... after `bounces` bounces.
Field after_bounces(const LinearOperator& transport, const Field& emission, long bounces);

/// What one operator answers. Errors are empty where it has no answer: `refusal` says why.
struct OperatorAnswer {
  std::string spec;
  std::size_t bytes = 0;
  std::optional<double> operator_error;  ///< of T in the area norm, relative
  std::optional<AnswerErrors> errors;
  std::string refusal;
};

/// Solves by the registry's choice of solver; operators whose equations have no solution keep empty errors.
OperatorAnswer operator_answer(const std::string& spec, const LitScene& scene, bool with_operator_error,
                               const OperatorRegistry& operators, const SolverRegistry& solvers,
                               Monitor& monitor);

}  // namespace radiosity

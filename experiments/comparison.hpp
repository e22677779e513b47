#pragma once

#include "experiments/certification.hpp"
#include "experiments/lights.hpp"
#include "experiments/machine.hpp"
#include "form_factors/form_factors.hpp"
#include "foundation/monitor.hpp"
#include "operators/operator_registry.hpp"
#include "solvers/solver_registry.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

struct ComparisonOptions {
  std::vector<std::string> operators;  ///< specs, at least one
  std::string solver;                  ///< spec; empty: the registry's default
  LightCounts lights;                  ///< none: the scene's own emission is the one light
  std::uint64_t seed = 1;
  SolverOptions solver_options;
  std::optional<Machine> machine;  ///< as measured before; measured anew if it is not given
  Index largest_measured =
      5000;  ///< patches up to which ||A - T||_F is computed, which costs n products a spec
};

/// Shortest and middle time of several runs, in seconds.
struct Timing {
  double min = 0;
  double median = 0;

  /// Throws UsageError for no samples.
  static Timing of(std::vector<double> samples);
};

/// Relative and weighted by area (architecture.md, "JSON of compare"): how far from the double-precision
/// solution with the same F. Empty where that is out of reach.
struct ComparisonErrors {
  std::optional<double> operator_frobenius;  ///< ||A - T||_F / ||T||_F of the entries A^{1/2} T A^{-1/2},
                                             ///< over all channels; empty for operators that map E to B
  std::optional<double> radiosity_mean;      ///< of ||B - B_ref||_A / ||B_ref||_A over the lights
  std::optional<double> radiosity_max;
  std::optional<double> indirect_mean;  ///< the same for B - E
  std::optional<double> indirect_max;
};

/// One operator of the comparison.
struct ComparisonResult {
  std::string spec;    ///< as it was given
  std::string solver;  ///< as the solver describes itself; empty where the operator answers by itself
  std::size_t bytes = 0;
  double build_seconds = 0;
  std::optional<DeviceUse> device;  ///< empty: the CPU
  double device_apply_seconds =
      0;         ///< of the device in a product, fields on their way not included; the mean
  Timing apply;  ///< one product with n x channels
  Timing solve;  ///< one light, over the lights; a solver that factors shows it in its first one
  ComparisonErrors errors;
  std::optional<double> row_sum_min;  ///< of its F, over live patches; empty for operators that map E to B
  std::optional<double> row_sum_max;
  std::optional<double> spectral_radius;          ///< of T by power iteration; empty for the same
  std::optional<CertificateSummary> certificate;  ///< empty where F has no symmetric kernel
  std::string remark;                             ///< of the operator; empty if it has none
  int iterations = 0;  ///< largest number of products for any light; 0 for a direct answer
};

struct Comparison {
  FormFactors form_factors;
  Machine machine;
  LightSet lights;
  std::vector<ComparisonResult> results;  ///< one a spec, in the order given
};

/// Builds, times and solves every operator with every light of the set. The reference is the double-precision
/// solution of `form_factors` to a residual of 1e-12. Throws Error (or UsageError) with the spec in its
/// sentence if an operator cannot be built, a solver refuses it or is named for one that needs none, and if
/// there is no light.
Comparison compare(const FormFactors& form_factors, const OperatorRegistry& operators,
                   const SolverRegistry& solvers, const ComparisonOptions& options, Monitor& monitor);

/// The JSON of `compare` (architecture.md). Appears whole or not at all.
void write_comparison_json(const std::filesystem::path& file, const Comparison& comparison);

/// The results as aligned columns for a terminal, ending with a newline.
std::string comparison_table(const Comparison& comparison);

}  // namespace radiosity

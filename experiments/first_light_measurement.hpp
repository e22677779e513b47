#pragma once

#include "experiments/comparison.hpp"
#include "render/reference_comparison.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace radiosity {

struct FirstLightOptions {
  std::string scene = "cornell-box-closed";
  std::vector<Index> patches = {300, 800, 1600, 3300};  ///< wanted sizes, rising
  std::vector<std::string> operators = {"dense", "dense:f32", "dense:f16", "csr"};
  double tolerance = 1e-8;  ///< relative residual of the operators' solutions: below the errors to be shown
  int reference_paths = 8192;  ///< of the path tracer, from each patch
  int picture_size = 800;      ///< pixels each way
  std::uint64_t seed = 1;
};

/// Solutions with one set of form factors, beside the accurate ones and beside the referee.
struct FirstLightSolution {
  FormFactorQuality quality;       ///< after the closure, where there is one
  double radiosity_error = 0;      ///< relative, area-weighted, against the accurate form factors
  double indirect_error = 0;       ///< the same for B - E
  ReferenceComparison difference;  ///< against path tracing
};

/// Everything that first light measures on one mesh.
struct FirstLightSize {
  std::shared_ptr<const PatchMesh> mesh;
  double raw_row_sum_rms = 0;  ///< of the accurate form factors before their closure
  FirstLightSolution accurate;
  FirstLightSolution one_ray;
  std::vector<ComparisonResult> operators;  ///< on the accurate form factors, lit by the scene's own light
  PathTracedIrradiance referee;
  Field radiosity;  ///< of the accurate form factors, to a residual of 1e-12
};

/// The measurements at each size, and the machine.
struct FirstLightMeasurement {
  double tolerance = 0;  ///< relative residual at which the operators' solutions stopped
  Machine machine;
  std::vector<FirstLightSize> sizes;
};

/// Measures every size. Throws Error if the reference solution cannot be had.
FirstLightMeasurement measure_first_light(const FirstLightOptions& options, const OperatorRegistry& operators,
                                          const SolverRegistry& solvers, Monitor& monitor);

}  // namespace radiosity

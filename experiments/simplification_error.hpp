#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/monitor.hpp"
#include "operators/linear_operator.hpp"
#include "scene/voxel_simplification.hpp"

namespace radiosity {

/// What simplifying a scene to voxels does to its indirect light.
struct SimplificationError {
  Index wanted = 0;
  Index patches = 0;          ///< what the grid has
  double indirect_error = 0;  ///< ||I~ - I||_A / ||I||_A over the original patches, I = B - E
  double simplify_seconds = 0;
  double form_factor_seconds = 0;  ///< of the simplified scene
  double solve_seconds = 0;
  double transfer_seconds = 0;  ///< to pull the light back
};

/// The irradiance H = F B of a simplified scene, m x channels, W/m^2, solved to a residual of 1e-12. Throws
/// Error where no solver gets there.
Field simplified_irradiance(const FormFactors& form_factors);

/// Solves the mesh of `form_factors`, with its emission, once more on about `wanted` voxels and compares the
/// light pulled back with B (n x channels, W/m^2), the solution of the mesh itself (reference_solution()).
/// The form factors of the simplified scene are computed with `options`. What it measures is all of:
/// geometry, mean reflectances, the coarser mesh and the transfer. Throws Error where there is no indirect
/// light to compare with.
SimplificationError measure_simplification(const FormFactors& form_factors, const Field& radiosity,
                                           Index wanted, const FormFactorOptions& options, Monitor& monitor);

}  // namespace radiosity

#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/monitor.hpp"
#include "operators/linear_operator.hpp"
#include "scene/voxel_simplification.hpp"

namespace radiosity {

/// Relative errors of indirect light, ||I~ - I||_A / ||I||_A over the original patches with I = B - E, over
/// the lights.
struct IndirectErrors {
  double mean = 0;
  double max = 0;
};

/// What simplifying a scene to voxels does to its indirect light.
struct SimplificationError {
  Index wanted = 0;
  Index patches = 0;  ///< m, what the grid has
  IndirectErrors indirect;
  /// The same where nothing is solved: the irradiance of the original itself, averaged over each voxel and
  /// pulled back. So much is lost by few patches; what is above is the fault of their shape.
  IndirectErrors averaged;
  double leaked = 0;  ///< part of the probe rays that left an enclosure, before a closure; 0 where it is none
  double on_backs = 0;  ///< part of the probe rays that ended on the back of a patch
  double simplify_seconds = 0;
  double form_factor_seconds = 0;  ///< of the simplified scene
  double solve_seconds = 0;        ///< a light
  double transfer_seconds = 0;     ///< to pull the light back, a light

  std::size_t factor_bytes() const;  ///< m^2 scalars in float32
};

/// The irradiance H = F B of a scene, n x (lights * channels), W/m^2, with B = E + T B solved to a residual
/// of 1e-12. Throws Error where no solver gets there.
Field irradiance_of_lights(const FormFactors& form_factors, const Field& emission);

/// The errors of indirect light I~ against I, n x (lights * channels). Lights without any do not count;
/// throws Error where no other is left.
IndirectErrors indirect_errors(const PatchMesh& mesh, const Field& indirect, const Field& reference);

/// Solves the mesh of `form_factors` once more on about `wanted` voxels, for each of the lights E, n x
/// (lights
/// * channels), and compares the light pulled back with B, the solution of the mesh itself
/// (reference_solution()). Form factors of the simplified scene are computed with `options`. The indirect
/// error is all of: geometry, mean reflectances, the coarser mesh and the transfer. Throws Error where there
/// is no indirect light to compare with.
SimplificationError measure_simplification(const FormFactors& form_factors, const Field& emission,
                                           const Field& radiosity, Index wanted,
                                           const FormFactorOptions& options, Monitor& monitor);

}  // namespace radiosity

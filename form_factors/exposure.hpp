#pragma once

#include "form_factors/occluders.hpp"
#include "form_factors/patch_geometry.hpp"
#include "foundation/monitor.hpp"

#include <Eigen/Core>

#include <cstdint>

namespace radiosity {

/// Where the light that leaves each patch ends up, found with cosine-distributed probe rays.
struct Exposure {
  Eigen::VectorXd
      exposed;  ///< n in mesh order: the fraction that ends on fronts; exactly 1 where every probe does
  std::uint64_t probe_rays = 0;
  std::uint64_t back_hits = 0;
  std::uint64_t leaks = 0;  ///< rays that left an enclosure: numerical, so they count as arrived
};

/// Nothing is traced in a convex enclosure, where everything is exposed. Elsewhere every patch sends 256
/// probes, and 4096 if one of them did not arrive on a front.
Exposure measure_exposure(const PatchMesh& mesh, const PatchGeometry& geometry, const Occluders& occluders,
                          std::uint64_t seed, Monitor& monitor);

}  // namespace radiosity

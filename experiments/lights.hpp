#pragma once

#include "foundation/monitor.hpp"
#include "scene/patch_mesh.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace radiosity {

enum class LightKind { area, point, patch };

/// How many lights of each kind: "area:4,point:4,patch:2".
struct LightCounts {
  Index area = 0;
  Index point = 0;
  Index patch = 0;

  Index total() const { return area + point + patch; }

  /// Throws UsageError for unknown kinds, kinds given twice and counts that are not whole numbers from 0 to
  /// 100000.
  static LightCounts parse(const std::string& text);
};

/// One light of a set, as it was drawn.
struct Light {
  LightKind kind = LightKind::patch;
  Vector3 position = Vector3::Zero();  ///< of the point; centre of the disc; centroid of the patch
  double radius = 0;                   ///< of the disc
  Index patch = -1;  ///< the patch that emits, or that holds the disc's centre; -1 for points
};

/// Lights as right-hand sides E, one after the other: area lights, points, patches.
struct LightSet {
  std::vector<Light> lights;
  Eigen::MatrixXd emission;  ///< n x (lights * channels), W/m^2
};

/// Draws lights (architecture.md, `--lights`), each from a random stream of its own, so that a light depends
/// on the seed and its place in the set alone:
/// - area: a disc on a surface, centre uniform by area, radius uniform in [0.02, 0.15] x scene diagonal; E =
/// 1 W/m^2 times the
///   fraction of each patch that it covers (exact), among the patches of the centre's group in its plane, in
///   every channel.
/// - point: uniform in the inner 80 % of the bounding box and outside solids, radiating 1 W evenly; E = rho x
/// the direct
///   irradiance with shadows. Without shadows that is the patch's solid angle / (4 pi A), exact; the part in
///   shadow is sampled at 16 stratified points a patch, weighted by what each would receive.
/// - patch: E = 1 W/m^2 on one random patch, in every channel.
/// No light is zero everywhere: such a point is drawn again. Throws Error if no place for a point is found.
LightSet draw_lights(const PatchMesh& mesh, const LightCounts& counts, std::uint64_t seed, Monitor& monitor);

}  // namespace radiosity

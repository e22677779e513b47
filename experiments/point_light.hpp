#pragma once

#include "experiments/lights.hpp"
#include "foundation/random.hpp"
#include "render/patch_rays.hpp"

#include <utility>

namespace radiosity {

/// Draws point lights of 1 W in one scene.
class PointLights {
 public:
  /// Keeps a reference to the mesh.
  explicit PointLights(const PatchMesh& mesh);

  /// A light that some patch reflects, and the direct irradiance of each patch, n, W/m^2.
  /// Throws Error after 1000 places of which none is fit.
  std::pair<Light, Eigen::VectorXd> draw(RandomStream& random) const;

  /// Direct irradiance with shadows, n, W/m^2. `seed` places the shadow rays.
  Eigen::VectorXd irradiance(const Vector3& position, std::uint64_t seed) const;

  /// Whether a point sees fronts of faces: of 64 directions that end on a face, at least three quarters end
  /// on its front. Inside a solid, and behind the walls of a room, they end on backs.
  bool outside_solids(const Vector3& position, RandomStream& random) const;

 private:
  bool visible(Index patch, const Vector3& point, const Vector3& position) const;
  double visible_part(Index patch, const Vector3& position, RandomStream& random) const;

  const PatchMesh& mesh_;
  PatchRays rays_;
};

/// Solid angle of a patch seen from `position`, in steradian; 0 from behind (Van Oosterom and Strackee 1983).
double front_solid_angle(const PatchMesh& mesh, Index patch, const Vector3& position);

}  // namespace radiosity

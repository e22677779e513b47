#pragma once

#include "scene/patch_mesh.hpp"

#include <memory>

namespace radiosity {

/// Where a ray ends: on the front or the back of a patch, or nowhere (patch = -1).
struct PatchHit {
  Index patch = -1;
  bool front = false;
  Vector3 point = Vector3::Zero();  ///< in scene units, on the plane of the patch

  bool missed() const { return patch < 0; }
};

/// Rays against the patches themselves (not the coarse faces), so that a hit names its patch. Backs stop rays
/// as fronts do, unless asked otherwise; where a front and a back coincide (two-sided faces), the front
/// counts. Embree computes in float32: the patches are moved and scaled into the unit ball before, and rays
/// start `lift()` above their patch, so that gaps narrower than about 1e-6 of the scene cannot be seen into.
/// Safe from several threads.
class PatchRays {
 public:
  /// Throws Error if Embree cannot build its scene.
  explicit PatchRays(const PatchMesh& mesh);
  ~PatchRays();
  PatchRays(const PatchRays&) = delete;
  PatchRays& operator=(const PatchRays&) = delete;

  /// The first patch met by a ray that leaves `point` on the front of `patch`; `direction` is a unit vector.
  PatchHit from_patch(Index patch, const Vector3& point, const Vector3& direction) const;

  /// The first front met by a ray from anywhere: backs are looked through, so that a closed room can be seen
  /// from outside.
  PatchHit first_front(const Vector3& origin, const Vector3& direction) const;

  /// Whether anything stands between `a` on the front of `patch_a` and `b` on the front of `patch_b`.
  bool blocked(Index patch_a, const Vector3& a, Index patch_b, const Vector3& b) const;

  /// How far above its patch a ray starts, in scene units.
  double lift() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace radiosity

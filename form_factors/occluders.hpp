#pragma once

#include "form_factors/convex_polygon.hpp"
#include "form_factors/patch_geometry.hpp"
#include "form_factors/ray_packet.hpp"
#include "form_factors/shaft.hpp"

#include <memory>
#include <span>
#include <vector>

namespace radiosity {

/// What a ray that left a patch meets first.
struct RayHit {
  int face = -1;       ///< which of the obstacle's faces, -1: nothing
  bool front = false;  ///< the front of that face
};

/// The coarse faces of a scene, in the scaled scene, in their order (an empty polygon where a face has no
/// area).
std::vector<ConvexPolygon> coarse_faces(const PatchMesh& mesh, const PatchGeometry& geometry);

/// Faces as obstacles: for rays (Embree) and for proofs about pairs of patches.
class Occluders {
 public:
  explicit Occluders(const std::vector<ConvexPolygon>& faces);
  ~Occluders();
  Occluders(const Occluders&) = delete;
  Occluders& operator=(const Occluders&) = delete;

  /// Faces that can stand between two points of the scene: a face on the convex hull cannot.
  /// Empty: no ray is ever needed.
  const std::vector<Blocker>& blockers() const { return blockers_; }

  /// Sets packet.blocked for each of the packet's rays, from origin to target.
  void trace(RayPacket& packet) const;

  /// First hits of the packet's rays, from origin in the direction of target and beyond.
  void first_hits(const RayPacket& packet, RayHit* hits) const;

  /// CPU seconds of one thread for rtcOccluded16 alone on packets prepared beforehand: the least that tracing
  /// them can cost.
  double tracing_seconds(std::span<const RayPacket> packets) const;

 private:
  struct Tracer;
  void find_blockers(const std::vector<ConvexPolygon>& faces);

  std::unique_ptr<Tracer> tracer_;
  std::vector<Blocker> blockers_;
  std::vector<Eigen::Vector3f> face_normals_;
};

}  // namespace radiosity

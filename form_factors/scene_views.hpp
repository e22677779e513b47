#pragma once

#include "form_factors/occluders.hpp"
#include "form_factors/patch_geometry.hpp"
#include "scene/patch_mesh.hpp"
#include "scene/polygon.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace radiosity {

/// What is seen from a point of a surface: the first hit of each of a fixed set of cosine-weighted
/// directions.
struct SceneView {
  std::vector<int> faces;               ///< the coarse face, -1: nothing
  std::vector<Eigen::Vector3f> points;  ///< where, in the scaled scene
};

/// Sampled scene views and how much they differ (document 004, Figure 1 and section 3.2: "spatial
/// coherence").
class SceneViews {
 public:
  /// `directions`: a multiple of 16.
  SceneViews(const PatchMesh& mesh, int directions, std::uint64_t seed);

  /// From a point (in the mesh's coordinates) of a surface with this unit normal. Surfaces that face the same
  /// way look in the same directions.
  SceneView from(const Vector3& point, const Vector3& normal) const;

  /// 0 (the same) to 1: the mean over the directions of how little the surfaces that are hit continue each
  /// other: half of 1 - cosine of the angle between them, plus how far one hit is off the other's plane
  /// relative to the distance of the two hits, at most 1; 1 where one view sees something and the other
  /// nothing. Walls cut into many faces, and curved ones, count as one surface this way.
  double difference(const SceneView& a, const SceneView& b) const;

  /// The largest difference between the views from a patch's corners, drawn inwards by a tenth, and its
  /// middle: 0 for a patch that is coherent.
  double incoherence(const Polygon& patch) const;

 private:
  PatchGeometry geometry_;
  std::vector<ConvexPolygon> faces_;
  std::vector<Plane> planes_;
  Occluders occluders_;
  std::vector<Eigen::Vector3d> directions_;  ///< around the z axis
};

}  // namespace radiosity

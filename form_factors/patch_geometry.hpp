#pragma once

#include "form_factors/convex_polygon.hpp"
#include "form_factors/quadrature_points.hpp"
#include "kernels/instruction_set.hpp"
#include "scene/patch_mesh.hpp"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace radiosity {

/// Patches that lie close together: the unit of culling and of vector loops. Its patches are begin ... end -
/// 1 in the order of a PatchGeometry and all have the same number of corners.
struct PatchCluster {
  int number = 0;  ///< place in PatchGeometry::clusters()
  int begin = 0;
  int end = 0;
  bool coplanar = false;  ///< all patches lie in `plane` and face the same way
  Plane plane;
  std::vector<Eigen::Vector3d> hull;  ///< at most 8 points whose convex hull contains the cluster
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0;
};

/// The patches as form factor computations want them: recentred and scaled to a box of side 1 (form factors
/// do not depend on either, float32 rays do), ordered cluster by cluster, in flat arrays.
class PatchGeometry {
 public:
  explicit PatchGeometry(const PatchMesh& mesh);

  static constexpr int cluster_size = 32;

  int patch_count() const { return static_cast<int>(to_mesh_.size()); }
  int to_mesh(int patch) const { return to_mesh_[static_cast<std::size_t>(patch)]; }
  int from_mesh(Index patch) const { return from_mesh_[static_cast<std::size_t>(patch)]; }

  const std::vector<PatchCluster>& clusters() const { return clusters_; }

  const PatchCluster& cluster_of(int patch) const {
    return clusters_[static_cast<std::size_t>(cluster_of_[static_cast<std::size_t>(patch)])];
  }

  const ConvexPolygon& polygon(int patch) const { return polygons_[static_cast<std::size_t>(patch)]; }
  const Plane& plane(int patch) const { return planes_[static_cast<std::size_t>(patch)]; }
  double area(int patch) const { return area_[static_cast<std::size_t>(patch)]; }
  double radius(int patch) const { return radius_[static_cast<std::size_t>(patch)]; }
  int group(int patch) const { return group_[static_cast<std::size_t>(patch)]; }

  /// Area of a group in the scaled scene.
  double group_area(int group) const { return group_area_[static_cast<std::size_t>(group)]; }

  /// From the mesh's coordinates to the scaled ones, and the factor for lengths.
  Eigen::Vector3d scaled(const Eigen::Vector3d& point) const { return (point - origin_) * scale_; }
  double scale() const { return scale_; }

  const QuadraturePoints& quadrature() const { return *quadrature_; }

 private:
  void order_patches(const PatchMesh& mesh);
  void add_clusters(const PatchMesh& mesh, std::span<int> patches, bool coplanar);
  void finish_clusters();

  Eigen::Vector3d origin_;
  double scale_ = 1;
  std::vector<int> to_mesh_, from_mesh_, cluster_of_, group_;
  std::vector<ConvexPolygon> polygons_;
  std::vector<Plane> planes_;
  std::vector<double> area_, radius_, group_area_;
  std::vector<PatchCluster> clusters_;
  std::unique_ptr<QuadraturePoints> quadrature_;
};

}  // namespace radiosity

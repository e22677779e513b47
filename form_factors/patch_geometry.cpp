#include "form_factors/patch_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace radiosity {
namespace {

using Eigen::Vector3d;

// Four corners of the smallest rectangle along the first edge's direction that holds all points of a plane.
std::vector<Vector3d> bounding_rectangle(const std::vector<Vector3d>& points, const Vector3d& normal) {
  const Vector3d u = (points[1] - points[0]).normalized(), v = normal.cross(u);
  double u_low = 1e300, u_high = -1e300, v_low = 1e300, v_high = -1e300;
  for (const Vector3d& point : points) {
    const Vector3d d = point - points[0];
    u_low = std::min(u_low, d.dot(u)), u_high = std::max(u_high, d.dot(u));
    v_low = std::min(v_low, d.dot(v)), v_high = std::max(v_high, d.dot(v));
  }
  const auto at = [&](double s, double t) -> Vector3d { return points[0] + s * u + t * v; };
  return {at(u_low, v_low), at(u_high, v_low), at(u_high, v_high), at(u_low, v_high)};
}

std::vector<Vector3d> bounding_box_corners(const std::vector<Vector3d>& points) {
  Vector3d low = points[0], high = points[0];
  for (const Vector3d& point : points) low = low.cwiseMin(point), high = high.cwiseMax(point);
  std::vector<Vector3d> corners;
  corners.reserve(8);
  for (int k = 0; k < 8; ++k)
    corners.emplace_back((k & 1) ? high.x() : low.x(), (k & 2) ? high.y() : low.y(),
                         (k & 4) ? high.z() : low.z());
  return corners;
}

}  // namespace

PatchGeometry::PatchGeometry(const PatchMesh& mesh) {
  Vector3d low = Vector3d::Constant(1e300), high = -low;
  for (const Vector3d& vertex : mesh.vertices) low = low.cwiseMin(vertex), high = high.cwiseMax(vertex);
  for (const Vector3d& vertex : mesh.scene->vertices)
    low = low.cwiseMin(vertex), high = high.cwiseMax(vertex);
  origin_ = 0.5 * (low + high);
  const double extent = (high - low).maxCoeff();
  scale_ = extent > 0 ? 1 / extent : 1;

  order_patches(mesh);
  const auto n = to_mesh_.size();
  from_mesh_.resize(n);
  group_area_.assign(mesh.scene->groups.size(), 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const Index patch = to_mesh_[i];
    from_mesh_[static_cast<std::size_t>(patch)] = static_cast<int>(i);
    ConvexPolygon polygon;
    Vector3d center = Vector3d::Zero();
    const int corners = mesh.patches[static_cast<std::size_t>(patch)].corner_count;
    for (int k = 0; k < corners; ++k) {
      polygon.add(scaled(mesh.corner(patch, k)));
      center += polygon[k] / corners;
    }
    double radius = 0;
    for (int k = 0; k < corners; ++k) radius = std::max(radius, (polygon[k] - center).norm());
    const Vector3d area = polygon.area_vector();
    Plane plane;
    plane.normal = area.normalized();
    plane.offset = plane.normal.dot(center);
    polygons_.push_back(polygon);
    planes_.push_back(plane);
    area_.push_back(area.norm());
    radius_.push_back(radius);
    const int group = mesh.patches[static_cast<std::size_t>(patch)].group;
    group_.push_back(group);
    group_area_[static_cast<std::size_t>(group)] += area.norm();
  }
  finish_clusters();
  quadrature_ = std::make_unique<QuadraturePoints>(polygons_, planes_);
}

// Patches of one face with equally many corners make coplanar clusters; faces with few patches are gathered
// from the whole scene, by place.
void PatchGeometry::order_patches(const PatchMesh& mesh) {
  std::map<std::pair<int, int>, std::vector<int>> by_face;
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const Patch& patch = mesh.patches[static_cast<std::size_t>(i)];
    by_face[{patch.face, patch.corner_count}].push_back(static_cast<int>(i));
  }
  std::map<int, std::vector<int>> loose;
  constexpr std::size_t few = 4;
  for (auto& [key, patches] : by_face) {
    if (patches.size() > few) {
      add_clusters(mesh, patches, true);
    } else {
      auto& list = loose[key.second];
      list.insert(list.end(), patches.begin(), patches.end());
    }
  }
  for (auto& [corners, patches] : loose) add_clusters(mesh, patches, false);
}

void PatchGeometry::add_clusters(const PatchMesh& mesh, std::span<int> patches, bool coplanar) {
  if (patches.size() > cluster_size) {
    Vector3d low = Vector3d::Constant(1e300), high = -low;
    for (const int i : patches)
      low = low.cwiseMin(mesh.centroid.col(i)), high = high.cwiseMax(mesh.centroid.col(i));
    Index axis = 0;
    (high - low).maxCoeff(&axis);
    const auto middle = patches.begin() + static_cast<std::ptrdiff_t>(patches.size() / 2);
    std::nth_element(patches.begin(), middle, patches.end(), [&](int a, int b) {
      return std::pair(mesh.centroid(axis, a), a) < std::pair(mesh.centroid(axis, b), b);
    });
    add_clusters(mesh, patches.subspan(0, patches.size() / 2), coplanar);
    add_clusters(mesh, patches.subspan(patches.size() / 2), coplanar);
    return;
  }
  std::sort(patches.begin(), patches.end());
  PatchCluster cluster;
  cluster.number = static_cast<int>(clusters_.size());
  cluster.begin = static_cast<int>(to_mesh_.size());
  to_mesh_.insert(to_mesh_.end(), patches.begin(), patches.end());
  cluster.end = static_cast<int>(to_mesh_.size());
  cluster_of_.resize(to_mesh_.size(), cluster.number);
  cluster.coplanar = coplanar || patches.size() == 1;
  clusters_.push_back(cluster);
}

void PatchGeometry::finish_clusters() {
  for (PatchCluster& cluster : clusters_) {
    std::vector<Vector3d> points;
    for (int i = cluster.begin; i < cluster.end; ++i)
      for (int k = 0; k < polygon(i).corner_count(); ++k) points.push_back(polygon(i)[k]);
    cluster.plane = plane(cluster.begin);
    cluster.hull =
        cluster.coplanar ? bounding_rectangle(points, cluster.plane.normal) : bounding_box_corners(points);
    cluster.center = Vector3d::Zero();
    for (const Vector3d& point : cluster.hull)
      cluster.center += point / static_cast<double>(cluster.hull.size());
    for (const Vector3d& point : cluster.hull)
      cluster.radius = std::max(cluster.radius, (point - cluster.center).norm());
  }
}

}  // namespace radiosity

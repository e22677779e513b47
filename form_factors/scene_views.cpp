#include "form_factors/scene_views.hpp"

#include "form_factors/pair_sampler.hpp"
#include "form_factors/sobol_points.hpp"
#include "foundation/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace radiosity {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// Cosine-weighted directions around the z axis: a shifted Sobol sequence on the disc, lifted.
std::vector<Vector3d> cosine_directions(int count, std::uint64_t seed) {
  const SobolPoints sobol;
  const auto shift = PairSampler::random_shift(seed, 0);
  const auto fraction = [&](int dimension, std::uint32_t k) {
    return (static_cast<double>(sobol(dimension, k) ^ shift[static_cast<std::size_t>(dimension)]) + 0.5) *
           0x1p-32;
  };
  std::vector<Vector3d> directions;
  directions.reserve(static_cast<std::size_t>(count));
  for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(count); ++k) {
    const double u = fraction(0, k), angle = 2 * std::numbers::pi * fraction(1, k);
    directions.emplace_back(std::sqrt(u) * std::cos(angle), std::sqrt(u) * std::sin(angle), std::sqrt(1 - u));
  }
  return directions;
}

Plane plane_of(const ConvexPolygon& polygon) {
  Plane plane;
  if (polygon.corner_count() < 3) return plane;
  plane.normal = polygon.area_vector().normalized();
  plane.offset = plane.normal.dot(polygon[0]);
  return plane;
}

}  // namespace

SceneViews::SceneViews(const PatchMesh& mesh, int directions, std::uint64_t seed)
    : geometry_(mesh), faces_(coarse_faces(mesh, geometry_)), occluders_(faces_) {
  if (directions < RayPacket::size || directions % RayPacket::size != 0)
    fail<UsageError>("a scene view of {} directions: it must be a multiple of {}", directions,
                     int{RayPacket::size});
  directions_ = cosine_directions(directions, seed);
  planes_.reserve(faces_.size());
  for (const ConvexPolygon& face : faces_) planes_.push_back(plane_of(face));
}

SceneView SceneViews::from(const Vector3& point, const Vector3& normal) const {
  const Vector3d s = normal.unitOrthogonal(), t = normal.cross(s);
  const Vector3d origin = geometry_.scaled(point) + PairSampler::most_stand_off * normal;
  SceneView view;
  view.faces.resize(directions_.size());
  view.points.resize(directions_.size());
  RayPacket packet;
  std::array<RayHit, RayPacket::size> hits;
  std::array<Vector3d, RayPacket::size> along;
  for (std::size_t first = 0; first < directions_.size(); first += RayPacket::size) {
    for (std::size_t l = 0; l < RayPacket::size; ++l) {
      const Vector3d& d = directions_[first + l];
      along[l] = d.x() * s + d.y() * t + d.z() * normal;
      const Vector3f from = origin.cast<float>(), to = (origin + along[l]).cast<float>();
      packet.origin_x[l] = from.x(), packet.origin_y[l] = from.y(), packet.origin_z[l] = from.z();
      packet.target_x[l] = to.x(), packet.target_y[l] = to.y(), packet.target_z[l] = to.z();
      packet.active[l] = -1;
    }
    occluders_.first_hits(packet, hits.data());
    for (std::size_t l = 0; l < RayPacket::size; ++l) {
      view.faces[first + l] = hits[l].face;
      view.points[first + l].setZero();
      if (hits[l].face < 0) continue;
      const Plane& plane = planes_[static_cast<std::size_t>(hits[l].face)];
      const double slope = plane.normal.dot(along[l]);
      const double distance = slope == 0 ? 0 : -plane.height(origin) / slope;
      view.points[first + l] = (origin + distance * along[l]).cast<float>();
    }
  }
  return view;
}

double SceneViews::difference(const SceneView& a, const SceneView& b) const {
  double sum = 0;
  for (std::size_t k = 0; k < a.faces.size(); ++k) {
    if (a.faces[k] == b.faces[k]) continue;
    if (a.faces[k] < 0 || b.faces[k] < 0) {
      sum += 1;
      continue;
    }
    const Plane& first = planes_[static_cast<std::size_t>(a.faces[k])];
    const Plane& second = planes_[static_cast<std::size_t>(b.faces[k])];
    const Vector3d p = a.points[k].cast<double>(), q = b.points[k].cast<double>();
    const double apart = (p - q).norm();
    const double off =
        apart > 0 ? std::max(std::fabs(first.height(q)), std::fabs(second.height(p))) / apart : 0;
    sum += std::min(1.0, 0.5 * (1 - first.normal.dot(second.normal)) + off);
  }
  return sum / static_cast<double>(a.faces.size());
}

double SceneViews::incoherence(const Polygon& patch) const {
  constexpr double inwards = 0.1;
  const Vector3 normal = area_vector(patch).normalized();
  Vector3 middle = Vector3::Zero();
  for (const Vector3& corner : patch) middle += corner / static_cast<double>(patch.size());
  std::vector<SceneView> views = {from(middle, normal)};
  views.reserve(patch.size() + 1);
  for (const Vector3& corner : patch)
    views.push_back(from((1 - inwards) * corner + inwards * middle, normal));
  double worst = 0;
  for (std::size_t i = 0; i < views.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) worst = std::max(worst, difference(views[i], views[j]));
  return worst;
}

}  // namespace radiosity

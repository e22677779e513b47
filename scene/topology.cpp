#include "scene/contacts.hpp"
#include "scene/scene.hpp"
#include "scene/vertex_welding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace radiosity {
namespace {

// Relative to the diagonal: what counts as one point, and as a point on an edge.
constexpr double kWeldTolerance = 1e-6;

using Edge = std::pair<int, int>;  // from, to: welded vertices

/// Drops every edge together with an edge that runs the opposite way.
void cancel_opposite(std::vector<Edge>& edges) {
  struct Run {
    Edge key;
    int count;
  };
  std::vector<Run> runs;
  runs.reserve(edges.size());
  for (const auto& [from, to] : edges)
    if (from != to) runs.push_back(from < to ? Run{{from, to}, 1} : Run{{to, from}, -1});
  std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.key < b.key; });
  edges.clear();
  for (std::size_t i = 0; i < runs.size();) {
    int sum = 0;
    const Edge key = runs[i].key;
    for (; i < runs.size() && runs[i].key == key; ++i) sum += runs[i].count;
    for (; sum > 0; --sum) edges.push_back(key);
    for (; sum < 0; ++sum) edges.emplace_back(key.second, key.first);
  }
}

/// Splits edges at every end of another edge that lies on them.
std::vector<Edge> split_at_ends(const std::vector<Edge>& edges, const std::vector<Vector3>& vertices,
                                double tolerance) {
  std::vector<int> ends;
  for (const auto& [from, to] : edges) {
    ends.push_back(from);
    ends.push_back(to);
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  const auto position = [&](int vertex) -> const Vector3& {
    return vertices[static_cast<std::size_t>(vertex)];
  };
  // Sorted along x, so that an edge looks only at the ends beside it.
  std::sort(ends.begin(), ends.end(), [&](int a, int b) { return position(a).x() < position(b).x(); });

  std::vector<Edge> pieces;
  std::vector<std::pair<double, int>> stops;
  for (const auto& [from, to] : edges) {
    const Vector3 along = position(to) - position(from);
    const double length = along.norm();
    const double low = std::min(position(from).x(), position(to).x()) - tolerance;
    const double high = std::max(position(from).x(), position(to).x()) + tolerance;
    stops.assign({{0.0, from}, {length, to}});
    for (auto at = std::lower_bound(ends.begin(), ends.end(), low,
                                    [&](int vertex, double x) { return position(vertex).x() < x; });
         at != ends.end() && position(*at).x() <= high; ++at) {
      const Vector3 offset = position(*at) - position(from);
      const double t = offset.dot(along) / length;
      if (t > tolerance && t < length - tolerance && (offset - along * (t / length)).norm() <= tolerance)
        stops.emplace_back(t, *at);
    }
    std::sort(stops.begin(), stops.end());
    for (std::size_t k = 0; k + 1 < stops.size(); ++k)
      pieces.emplace_back(stops[k].second, stops[k + 1].second);
  }
  return pieces;
}

bool is_closed(const Scene& scene, double tolerance) {
  const std::vector<int> welded = weld(scene.vertices, tolerance);
  std::vector<Edge> edges;
  edges.reserve(scene.faces.size() * 3);
  for (const Face& face : scene.faces)
    for (int k = 0; k < face.corner_count; ++k) {
      const auto from = static_cast<std::size_t>(face.corners[static_cast<std::size_t>(k)]);
      const auto to =
          static_cast<std::size_t>(face.corners[static_cast<std::size_t>((k + 1) % face.corner_count)]);
      edges.emplace_back(welded[from], welded[to]);
    }
  cancel_opposite(edges);
  if (edges.empty()) return true;
  edges = split_at_ends(edges, scene.vertices, tolerance);
  cancel_opposite(edges);
  return edges.empty();
}

/// Divergence theorem: a third of the sum of (centre of a face) . (its area vector).
double signed_volume(const Scene& scene) {
  const Vector3 origin = corner(scene, scene.faces.front(), 0);
  double six_volumes = 0;
  for (const Face& face : scene.faces)
    for (int k = 1; k + 1 < face.corner_count; ++k)
      six_volumes += (corner(scene, face, 0) - origin)
                         .dot((corner(scene, face, k) - origin).cross(corner(scene, face, k + 1) - origin));
  return six_volumes / 6;
}

bool is_convex(const Scene& scene, double scale) {
  double farthest = 0;
  std::vector<bool> used(scene.vertices.size(), false);
  for (const Face& face : scene.faces)
    for (int k = 0; k < face.corner_count; ++k)
      used[static_cast<std::size_t>(face.corners[static_cast<std::size_t>(k)])] = true;
  std::vector<Vector3> vertices;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) {
      vertices.push_back(scene.vertices[i]);
      farthest = std::max(farthest, scene.vertices[i].cwiseAbs().maxCoeff());
    }
  const double tolerance = 1e-9 * scale + 8 * std::numeric_limits<double>::epsilon() * farthest;
  for (const Face& face : scene.faces) {
    const Vector3 area = area_vector(scene, face);
    if (area.norm() <= 1e-14 * scale * scale) continue;
    const Vector3 normal = area.normalized();
    const Vector3& origin = corner(scene, face, 0);
    for (const Vector3& vertex : vertices)
      if (normal.dot(vertex - origin) < -tolerance) return false;
  }
  return true;
}

}  // namespace

Topology topology(const Scene& given) {
  Topology result;
  if (given.faces.empty()) return result;
  const bool cutting = given.contacts == Contacts::always;
  const Scene cut = cutting ? without_contacts(given) : Scene{};
  const Scene& scene = cutting ? cut : given;
  const double scale = diagonal(scene);
  result.closed = is_closed(scene, kWeldTolerance * scale);
  result.volume = signed_volume(scene);
  result.enclosure = result.closed && result.volume < 0;
  result.convex = is_convex(scene, scale);
  return result;
}

}  // namespace radiosity

#include "scene/contacts.hpp"

#include "scene/half_edges.hpp"
#include "scene/vertex_welding.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace radiosity {
namespace {

constexpr double kRelativeTolerance = 1e-7;  // of the diagonal
constexpr double kParallel = 1e-6;           // sine of the largest angle between planes that count as one

/// Faces as planes {x : normal . x = offset} with their polygons.
struct Plane {
  Vector3 normal = Vector3::Zero();  // zero for a face without area
  double offset = 0;
};

Polygon polygon_of(const Scene& scene, const Face& face) {
  Polygon polygon;
  for (int k = 0; k < face.corner_count; ++k) polygon.push_back(corner(scene, face, k));
  return polygon;
}

std::vector<Plane> planes_of(const Scene& scene, double tolerance) {
  std::vector<Plane> planes;
  planes.reserve(scene.faces.size());
  for (const Face& face : scene.faces) {
    const Vector3 area = area_vector(scene, face);
    Plane plane;
    if (area.norm() > tolerance * tolerance) {
      plane.normal = area.normalized();
      plane.offset = plane.normal.dot(corner(scene, face, 0));
    }
    planes.push_back(plane);
  }
  return planes;
}

bool lies_in(const Polygon& polygon, const Plane& plane, double tolerance) {
  return std::all_of(polygon.begin(), polygon.end(), [&](const Vector3& point) {
    return std::abs(plane.normal.dot(point) - plane.offset) <= tolerance;
  });
}

/// Finds contacts face by face; see find_contacts().
class ContactFinder {
 public:
  explicit ContactFinder(const Scene& scene)
      : scene_(scene),
        tolerance_(contact_tolerance(scene)),
        planes_(planes_of(scene, tolerance_)),
        welded_(weld(scene.vertices, tolerance_)),
        edges_(half_edges(scene, welded_)),
        covers_(scene.faces.size()) {}

  Covers find() {
    for (const std::vector<int>& loop : boundary_loops(edges_)) cover_by_loop(loop);
    cover_by_opposite_faces();
    return std::move(covers_);
  }

 private:
  const Vector3& position(int vertex) const { return scene_.vertices[static_cast<std::size_t>(vertex)]; }
  const HalfEdge& edge(int i) const { return edges_[static_cast<std::size_t>(i)]; }

  /// The feet of a body: a plane loop none of whose faces lies in its plane.
  void cover_by_loop(const std::vector<int>& loop) {
    if (loop.size() < 3) return;
    Polygon polygon;
    for (const int i : loop) polygon.push_back(position(edge(i).from));
    const Vector3 area = area_vector(polygon);
    if (area.norm() <= tolerance_ * tolerance_) return;
    Plane plane{area.normalized(), 0};
    plane.offset = plane.normal.dot(polygon.front());
    if (!lies_in(polygon, plane, tolerance_)) return;
    for (const int i : loop) {
      const Vector3& normal = planes_[static_cast<std::size_t>(edge(i).face)].normal;
      if (normal.cross(plane.normal).norm() < 1e-3) return;
    }
    const std::vector<Polygon> parts = convex_parts(polygon, plane.normal, tolerance_);
    for (std::size_t f = 0; f < scene_.faces.size(); ++f) {
      if (planes_[f].normal.dot(plane.normal) < 0.5 ||
          std::abs(planes_[f].offset - plane.offset) > scale_slack(f))
        continue;
      const Polygon face = polygon_of(scene_, scene_.faces[f]);
      if (lies_in(face, plane, tolerance_)) add(f, face, parts);
    }
  }

  /// Offsets of nearly parallel planes differ by an angle times the distance to the origin.
  double scale_slack(std::size_t f) const {
    return tolerance_ + kParallel * corner(scene_, scene_.faces[f], 0).norm();
  }

  void add(std::size_t f, const Polygon& face, const std::vector<Polygon>& parts) {
    for (const Polygon& part : parts)
      if (overlap(face, part, planes_[f].normal, tolerance_)) covers_[f].push_back(part);
  }

  /// Pairs of faces in one plane that look opposite ways. A face is hashed to a number that coplanar faces
  /// share, and that changes its sign with the side the face looks to.
  void cover_by_opposite_faces() {
    const double scale = std::max(diagonal(scene_), tolerance_);
    const Vector3 direction(0.53, 0.61, 0.59);
    const Vector3 origin = scene_.vertices.front();
    std::vector<std::pair<double, std::size_t>> numbers;
    for (std::size_t f = 0; f < planes_.size(); ++f)
      if (!planes_[f].normal.isZero())
        numbers.emplace_back(
            planes_[f].normal.dot(direction) +
                1.3 * planes_[f].normal.dot(corner(scene_, scene_.faces[f], 0) - origin) / scale,
            f);
    std::sort(numbers.begin(), numbers.end());
    const double slack = 8 * kParallel;
    for (const auto& [number, f] : numbers) {
      if (number > slack) break;  // each pair is met once, from its negative side (twice around zero)
      for (auto other = std::lower_bound(numbers.begin(), numbers.end(),
                                         std::make_pair(-number - slack, std::size_t{0}));
           other != numbers.end() && other->first <= -number + slack; ++other)
        if (f < other->second || number < -slack) cover_pair(f, other->second);
    }
  }

  void cover_pair(std::size_t f, std::size_t g) {
    if (planes_[f].normal.dot(planes_[g].normal) > 0) return;
    const Polygon a = polygon_of(scene_, scene_.faces[f]);
    Polygon b = polygon_of(scene_, scene_.faces[g]);
    if (!lies_in(b, planes_[f], tolerance_) || !lies_in(a, planes_[g], tolerance_)) return;
    std::reverse(b.begin(), b.end());
    if (!overlap(a, b, planes_[f].normal, tolerance_) || is_sheet(f, g)) return;
    if (!has_body_in_front(g, planes_[f]) && !has_body_in_front(f, planes_[g])) return;
    covers_[f].push_back(b);
    Polygon reversed = a;
    std::reverse(reversed.begin(), reversed.end());
    covers_[g].push_back(std::move(reversed));
  }

  bool is_sheet(std::size_t f, std::size_t g) const {
    const auto corners = [&](const Face& face) {
      std::vector<int> result;
      result.reserve(4);
      for (int k = 0; k < face.corner_count; ++k)
        result.push_back(welded_[static_cast<std::size_t>(face.corners[static_cast<std::size_t>(k)])]);
      std::sort(result.begin(), result.end());
      return result;
    };
    return corners(scene_.faces[f]) == corners(scene_.faces[g]);
  }

  /// Whether a neighbour of the face rises above the plane.
  bool has_body_in_front(std::size_t f, const Plane& plane) {
    if (first_edge_.empty()) {
      first_edge_.assign(scene_.faces.size(), -1);
      for (std::size_t i = edges_.size(); i-- > 0;)
        first_edge_[static_cast<std::size_t>(edges_[i].face)] = static_cast<int>(i);
    }
    const int first = first_edge_[f];
    if (first < 0) return false;
    int i = first;
    do {
      if (edge(i).twin >= 0) {
        const Face& neighbour = scene_.faces[static_cast<std::size_t>(edge(edge(i).twin).face)];
        for (int k = 0; k < neighbour.corner_count; ++k)
          if (plane.normal.dot(corner(scene_, neighbour, k)) - plane.offset > 10 * tolerance_) return true;
      }
      i = edge(i).next;
    } while (i != first);
    return false;
  }

  const Scene& scene_;
  double tolerance_;
  std::vector<Plane> planes_;
  std::vector<int> welded_;
  std::vector<HalfEdge> edges_;
  std::vector<int> first_edge_;  // of each face
  Covers covers_;
};

}  // namespace

double contact_tolerance(const Scene& scene) {
  return kRelativeTolerance * diagonal(scene);
}

Covers find_contacts(const Scene& scene) {
  if (scene.faces.empty()) return {};
  return ContactFinder(scene).find();
}

std::vector<Polygon> uncovered(const Polygon& piece, const std::vector<Polygon>& covers,
                               const Vector3& normal, double tolerance) {
  std::vector<Polygon> pieces = {piece};
  for (const Polygon& cover : covers) {
    std::vector<Polygon> remaining;
    for (const Polygon& part : pieces)
      for (Polygon& rest : subtract(part, cover, normal, tolerance)) remaining.push_back(std::move(rest));
    pieces = std::move(remaining);
  }
  return pieces;
}

Scene without_contacts(const Scene& scene) {
  const Covers covers = find_contacts(scene);
  const double tolerance = contact_tolerance(scene);
  Scene result = scene;
  result.contacts = Contacts::never;
  result.faces.clear();
  for (std::size_t f = 0; f < scene.faces.size(); ++f) {
    const Face& face = scene.faces[f];
    if (covers[f].empty()) {
      result.faces.push_back(face);
      continue;
    }
    const Vector3 normal = area_vector(scene, face).normalized();
    for (const Polygon& rest : uncovered(polygon_of(scene, face), covers[f], normal, tolerance))
      for (const Polygon& part : triangles_and_quads(rest)) {
        Face piece = face;
        piece.corner_count = static_cast<int>(part.size());
        for (std::size_t k = 0; k < part.size(); ++k) {
          piece.corners[k] = static_cast<int>(result.vertices.size());
          result.vertices.push_back(part[k]);
        }
        result.faces.push_back(piece);
      }
  }
  return result;
}

}  // namespace radiosity

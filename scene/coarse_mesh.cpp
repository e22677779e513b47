#include "scene/coarse_mesh.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "scene/conforming_cells.hpp"
#include "scene/face_subdivision.hpp"
#include "scene/patch_division.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>

namespace radiosity {
namespace {

/// The nearest by centroid, the first of equals; -1 without candidates.
template <typename Allowed>
int nearest_patch(const PatchMesh& patches, const std::vector<int>& candidates, const Vector3& point,
                  const Allowed& allowed) {
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (const int p : candidates) {
    if (!allowed(p)) continue;
    const double distance = (patches.centroid.col(p) - point).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    best = p;
  }
  return best;
}

/// How far outside of a patch an element's centroid may be and count as inside, relative to the patch's edge.
constexpr double inside_slack = 1e-9;

/// The patches of each face, and all of them.
struct PatchLists {
  explicit PatchLists(const PatchMesh& patches)
      : of_face(patches.scene->faces.size()), all(patches.patches.size()) {
    std::iota(all.begin(), all.end(), 0);
    polygons.reserve(all.size());
    for (const int p : all) polygons.push_back(polygon_of(patches, p));
    for (const int p : all)
      of_face[static_cast<std::size_t>(patches.patches[static_cast<std::size_t>(p)].face)].push_back(p);
  }
  std::vector<std::vector<int>> of_face;
  std::vector<int> all;
  std::vector<Polygon> polygons;
};

int patch_of(const PatchMesh& elements, Index element, const PatchMesh& patches, const PatchLists& lists,
             Assignment assignment) {
  const Vector3 centroid = elements.centroid.col(element);
  const auto anything = [](int) { return true; };
  int found = -1;
  if (assignment == Assignment::inclusion) {
    const auto face = static_cast<std::size_t>(elements.patches[static_cast<std::size_t>(element)].face);
    const std::vector<int>& own = lists.of_face[face];
    const auto inside = std::find_if(own.begin(), own.end(), [&](int p) {
      return contains(lists.polygons[static_cast<std::size_t>(p)], centroid, patches.normal.col(p),
                      inside_slack);
    });
    found = inside != own.end() ? *inside : nearest_patch(patches, own, centroid, anything);
  } else {
    constexpr double cosine = 0.5;
    found = nearest_patch(patches, lists.all, centroid, [&](int p) {
      return patches.normal.col(p).dot(elements.normal.col(element)) > cosine;
    });
  }
  return found >= 0 ? found : nearest_patch(patches, lists.all, centroid, anything);
}

/// 0, the gaps nearest to 1 / parts, 2 / parts, ..., 1: each once. Without gaps, the places themselves.
std::vector<double> cuts_at(const std::vector<double>& gaps, std::int64_t parts) {
  std::vector<double> cuts = {0};
  for (std::int64_t i = 1; i < parts; ++i) {
    const double place = static_cast<double>(i) / static_cast<double>(parts);
    double cut = place;
    if (!gaps.empty()) {
      const auto after = std::lower_bound(gaps.begin(), gaps.end(), place);
      const bool take_before =
          after == gaps.end() || (after != gaps.begin() && place - *(after - 1) <= *after - place);
      cut = take_before ? *(after - 1) : *after;
    }
    if (cut > cuts.back()) cuts.push_back(cut);
  }
  cuts.push_back(1);
  return cuts;
}

/// Cells of a quad between rows of its elements.
std::vector<Polygon> aligned_grid(const PatchMesh& elements, const std::vector<Index>& members,
                                  const Polygon& quad, GridSize size) {
  const std::vector<double> u = cuts_at(gaps_along(elements, members, quad, 0), size.columns);
  const std::vector<double> v = cuts_at(gaps_along(elements, members, quad, 1), size.rows);
  const auto at = [&](double s, double t) -> Vector3 {
    return (1 - s) * (1 - t) * quad[0] + s * (1 - t) * quad[1] + s * t * quad[2] + (1 - s) * t * quad[3];
  };
  std::vector<Polygon> cells;
  cells.reserve((u.size() - 1) * (v.size() - 1));
  for (std::size_t j = 1; j < v.size(); ++j)
    for (std::size_t i = 1; i < u.size(); ++i)
      cells.push_back({at(u[i - 1], v[j - 1]), at(u[i], v[j - 1]), at(u[i], v[j]), at(u[i - 1], v[j])});
  return cells;
}

/// The patches of a mesh cut to one edge length, the shortest that gives no more than k.
PatchMesh cut_uniformly(const PatchMesh& elements, const CoarseMesh& mesh, Index k) {
  std::vector<Polygon> polygons;
  polygons.reserve(mesh.patches.patches.size());
  for (Index p = 0; p < mesh.patches.patch_count(); ++p) polygons.push_back(polygon_of(mesh.patches, p));
  const auto count_for = [&](double edge) {
    std::int64_t count = 0;
    for (const Polygon& polygon : polygons) {
      const GridSize size = polygon.size() == 4 ? grid_size(polygon, edge) : GridSize{};
      count += polygon.size() == 4 ? size.rows * size.columns : bisection_count(polygon, edge, 0);
    }
    return count;
  };
  const double edge = edges_around(diagonal(*mesh.patches.scene), k + 1, count_for).second;
  const std::vector<std::vector<Index>> members = elements_by_patch(mesh);
  std::vector<std::vector<Polygon>> parts(mesh.patches.scene->faces.size());
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    std::vector<Polygon> cells = polygons[p].size() == 4 ? aligned_grid(elements, members[p], polygons[p],
                                                                        grid_size(polygons[p], edge))
                                                         : bisect(polygons[p], edge, 0);
    auto& of_face = parts[static_cast<std::size_t>(mesh.patches.patches[p].face)];
    of_face.insert(of_face.end(), std::make_move_iterator(cells.begin()),
                   std::make_move_iterator(cells.end()));
  }
  return mesh_of_parts(mesh.patches, std::move(parts));
}

CoarseMesh elements_themselves(const PatchMesh& elements) {
  CoarseMesh coarse{elements, std::vector<int>(elements.patches.size())};
  std::iota(coarse.patch_of_element.begin(), coarse.patch_of_element.end(), 0);
  return coarse;
}

}  // namespace

Polygon polygon_of(const PatchMesh& mesh, Index patch) {
  Polygon polygon;
  const int corners = mesh.patches[static_cast<std::size_t>(patch)].corner_count;
  polygon.reserve(static_cast<std::size_t>(corners));
  for (int k = 0; k < corners; ++k) polygon.push_back(mesh.corner(patch, k));
  return polygon;
}

CoarseMesh assign_elements(const PatchMesh& elements, const PatchMesh& patches, Assignment assignment) {
  const PatchLists lists(patches);
  std::vector<int> assigned(elements.patches.size());
  constexpr std::size_t grain = 256;
  parallel_for(
      assigned.size(),
      [&](std::size_t e) {
        assigned[e] = patch_of(elements, static_cast<Index>(e), patches, lists, assignment);
      },
      grain);

  std::vector<int> number(patches.patches.size(), -1);
  for (const int p : assigned) number[static_cast<std::size_t>(p)] = 0;
  std::vector<std::vector<Polygon>> parts(patches.scene->faces.size());
  int kept = 0;
  for (const std::vector<int>& of_face : lists.of_face)
    for (const int p : of_face) {
      if (number[static_cast<std::size_t>(p)] < 0) continue;
      number[static_cast<std::size_t>(p)] = kept++;
      parts[static_cast<std::size_t>(patches.patches[static_cast<std::size_t>(p)].face)].push_back(
          lists.polygons[static_cast<std::size_t>(p)]);
    }
  for (int& p : assigned) p = number[static_cast<std::size_t>(p)];
  return {mesh_of_parts(patches, std::move(parts)), std::move(assigned)};
}

PatchMesh coarsest_patches(const PatchMesh& elements) {
  return make_patches(*elements.scene, {.patches = static_cast<Index>(elements.scene->faces.size())});
}

std::optional<CoarseMesh> uniform_coarse_mesh(const PatchMesh& elements, Index k, Assignment assignment) {
  if (!elements.scene) return std::nullopt;
  if (elements.patch_count() <= k) return elements_themselves(elements);
  const CoarseMesh coarsest = assign_elements(elements, coarsest_patches(elements), Assignment::inclusion);
  if (coarsest.patches.patch_count() > k) return std::nullopt;
  return assign_elements(elements, cut_uniformly(elements, coarsest, k), assignment);
}

std::vector<double> gaps_along(const PatchMesh& elements, const std::vector<Index>& members,
                               const Polygon& quad, std::size_t edge) {
  constexpr double least_gap = 1e-6;
  const Vector3& from = quad[edge];
  const Vector3 along = quad[edge + 1] - from;
  std::vector<double> places;
  places.reserve(members.size());
  for (const Index e : members)
    places.push_back(along.dot(elements.centroid.col(e) - from) / along.squaredNorm());
  std::sort(places.begin(), places.end());
  std::vector<double> gaps;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double middle = 0.5 * (places[i - 1] + places[i]);
    if (places[i] - places[i - 1] > least_gap && middle > 0 && middle < 1) gaps.push_back(middle);
  }
  return gaps;
}

std::vector<std::vector<Index>> elements_by_patch(const CoarseMesh& mesh) {
  std::vector<std::vector<Index>> members(mesh.patches.patches.size());
  for (std::size_t e = 0; e < mesh.patch_of_element.size(); ++e)
    members[static_cast<std::size_t>(mesh.patch_of_element[e])].push_back(static_cast<Index>(e));
  return members;
}

std::size_t longer_edges(const Polygon& quad) {
  const auto edge = [&](std::size_t k) { return (quad[(k + 1) % 4] - quad[k]).norm(); };
  return edge(0) + edge(2) >= edge(1) + edge(3) ? 0 : 1;
}

std::pair<Polygon, Polygon> cut_quad(const Polygon& quad, std::size_t edge, double at) {
  const auto corner = [&](std::size_t k) -> const Vector3& { return quad[(edge + k) % 4]; };
  const Vector3 near = corner(0) + at * (corner(1) - corner(0));
  const Vector3 far = corner(3) + at * (corner(2) - corner(3));
  return {{corner(0), near, far, corner(3)}, {near, corner(1), corner(2), far}};
}

std::pair<Polygon, Polygon> halve_triangle(const Polygon& triangle) {
  const auto edge = [&](std::size_t k) { return (triangle[(k + 1) % 3] - triangle[k]).squaredNorm(); };
  std::size_t longest = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (edge(k) > edge(longest)) longest = k;
  const Vector3& from = triangle[longest];
  const Vector3& to = triangle[(longest + 1) % 3];
  const Vector3& apex = triangle[(longest + 2) % 3];
  const Vector3 middle = 0.5 * (from + to);
  return {{from, middle, apex}, {middle, to, apex}};
}

}  // namespace radiosity

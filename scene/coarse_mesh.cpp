#include "scene/coarse_mesh.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "scene/patch_division.hpp"

#include <algorithm>
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
  const auto faces = static_cast<Index>(elements.scene->faces.size());
  // A wanted number is met only nearly: ask for less until what comes is no more than k.
  for (Index wanted = k; wanted >= faces;) {
    const PatchMesh patches = make_patches(*elements.scene, {.patches = wanted});
    const Index surplus = patches.patch_count() - k;
    if (surplus <= 0) return assign_elements(elements, patches, assignment);
    if (wanted == faces) break;
    wanted = std::max(faces, wanted - surplus);
  }
  return std::nullopt;
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

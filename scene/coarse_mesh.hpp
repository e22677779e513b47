#pragma once

#include "scene/patch_mesh.hpp"
#include "scene/polygon.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace radiosity {

/// Which patch of a coarse mesh an element of a fine one belongs to (document 004, section 3.2).
enum class Assignment {
  inclusion,  ///< the one on its face that contains its centroid; where none does, the nearest on that face
  proximity   ///< the one with the nearest centroid among those that face within 60 degrees of its direction
};

/// Two meshes of one scene (document 004, section 3.2): n elements, given elsewhere, and k patches.
struct CoarseMesh {
  PatchMesh patches;                  ///< k of them; each has an element at least
  std::vector<int> patch_of_element;  ///< P(e), n numbers 0 ... k - 1
};

/// P for these patches; patches that no element belongs to are left out.
CoarseMesh assign_elements(const PatchMesh& elements, const PatchMesh& patches, Assignment assignment);

/// The scene of `elements` in as few patches as its faces allow.
PatchMesh coarsest_patches(const PatchMesh& elements);

/// A uniform coarse mesh of at most k patches: the faces cut to one edge length, the shortest that gives no
/// more than k, between rows of elements; the elements themselves if there are no more than k. Empty if the
/// faces alone are more than k, or if nothing is known of the scene.
std::optional<CoarseMesh> uniform_coarse_mesh(const PatchMesh& elements, Index k, Assignment assignment);

/// The elements of each patch, rising.
std::vector<std::vector<Index>> elements_by_patch(const CoarseMesh& mesh);

/// Where along an edge (0 or 1) of a quad, from 0 to 1, its elements leave gaps between their rows: rising.
std::vector<double> gaps_along(const PatchMesh& elements, const std::vector<Index>& members,
                               const Polygon& quad, std::size_t edge);

/// The edge, 0 or 1, that is longer together with the one opposite.
std::size_t longer_edges(const Polygon& quad);

/// A quad in two, from the point `at` (0 to 1) along `edge` to that along the opposite edge; what lies before
/// the cut comes first.
std::pair<Polygon, Polygon> cut_quad(const Polygon& quad, std::size_t edge, double at);

/// A triangle in two across its longest edge, the first of equals.
std::pair<Polygon, Polygon> halve_triangle(const Polygon& triangle);

/// The corners of a patch.
Polygon polygon_of(const PatchMesh& mesh, Index patch);

}  // namespace radiosity

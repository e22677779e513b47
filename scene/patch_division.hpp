#pragma once

#include "scene/contacts.hpp"
#include "scene/patch_mesh.hpp"

#include <vector>

namespace radiosity {

/// The patches of each face of a scene, as triangles and planar convex quads.
struct Division {
  std::vector<std::vector<Polygon>> parts;  ///< one list a face; empty for faces that were left out
  std::size_t dropped_pieces =
      0;  ///< remains beside a contact, below 1e-9 of the cell that they are cut from
};

/// Divides the faces for which `used` is set, with `covers` left out of them.
/// Throws UsageError for a subdivision that asks for something impossible.
Division divide_faces(const Scene& scene, const std::vector<bool>& used, const Covers& covers,
                      const Subdivision& subdivision);

/// A mesh of the same scene as `other` with these parts of its faces (triangles and planar convex quads) as
/// patches, face by face. Reflectance and emission are those of the materials.
PatchMesh mesh_of_parts(const PatchMesh& other, std::vector<std::vector<Polygon>> parts);

}  // namespace radiosity

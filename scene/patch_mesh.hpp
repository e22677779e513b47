#pragma once

#include "scene/scene.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace radiosity {

using Index = Eigen::Index;

/// A planar convex triangle or quad on which radiosity is constant.
struct Patch {
  std::array<int, 4> corners{};  ///< indices into PatchMesh::vertices, counter-clockwise seen from the front
  int corner_count = 3;          ///< 3 or 4
  int face = 0;                  ///< the coarse face (index into Scene::faces) that the patch is part of
  int group = 0;
  int material = 0;
};

/// The n patches of a scene with all that transport needs to know of them. Quantities are per patch, in patch
/// order. Fields have n rows and one column a channel: 3 (linear RGB), or 1 where reflectance and emission
/// are grey.
struct PatchMesh {
  std::shared_ptr<const Scene> scene;  ///< coarse faces: what blocks rays
  std::vector<Vector3> vertices;
  std::vector<Patch> patches;
  Eigen::VectorXd area;         ///< n, m^2, > 0
  Eigen::Matrix3Xd normal;      ///< 3 x n, unit, towards the front
  Eigen::Matrix3Xd centroid;    ///< 3 x n
  Eigen::MatrixXd reflectance;  ///< n x channels, 0 <= rho <= 1
  Eigen::MatrixXd emission;     ///< n x channels, W/m^2
  Topology topology;            ///< of the coarse scene
  std::vector<std::string> notes;

  Index patch_count() const { return static_cast<Index>(patches.size()); }
  Index channels() const { return reflectance.cols(); }
  const Vector3& corner(Index patch, int k) const {
    const Patch& p = patches[static_cast<std::size_t>(patch)];
    return vertices[static_cast<std::size_t>(p.corners[static_cast<std::size_t>(k)])];
  }

  /// Fingerprint of everything that F depends on: patch corners in order and the coarse faces (not
  /// reflectance or emission).
  std::uint64_t geometry_hash() const;
};

/// How finely to cut. At most one of `patches` and `edge` is set; neither: each face is one patch.
struct Subdivision {
  Index patches = 0;  ///< wanted number of patches; box-like scenes get the nearest 6 m^2, others come as
                      ///< close as they can
  double edge = 0;    ///< longest edge allowed, in scene units
  int passes = 0;     ///< with `edge`: bisect a triangle at most so many times, though its edges stay longer
                      ///< (document 003); 0: no limit
};

/// Cuts the faces of a scene into patches. Rectangles and other quads become grids; triangles are bisected
/// across their longest edge, longest first. Patches run face by face, a grid row by row. What stands on a
/// face is cut out of it (scene/contacts.hpp). Faces of zero area are dropped and counted in `notes`. Throws
/// UsageError if fewer patches are wanted than the scene has faces, Error if no face is left.
PatchMesh make_patches(const Scene& scene, const Subdivision& subdivision = {});

/// Multiplies reflectances above `limit` down to it, channel-wise scale of the whole material, and says in
/// `notes` which. Throws Error naming the first patch with rho >= 1 if `limit` is 0 (not given).
void limit_reflectance(PatchMesh& mesh, double limit);

}  // namespace radiosity

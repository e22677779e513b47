#pragma once

#include "scene/patch_mesh.hpp"
#include "scene/voxel_fragments.hpp"
#include "scene/voxel_grid.hpp"

#include <memory>
#include <vector>

namespace radiosity {

/// A scene of few patches, one a voxel and direction, in place of one of many faces (document 000,
/// section 3.2).
struct SimplifiedScene {
  /// The quads (scene/voxel_quads.hpp), in the order of cells and directions. Its scene has one face a patch:
  /// the quads are what blocks light. Groups are those of the original, each quad in the one with most area.
  std::shared_ptr<const PatchMesh> mesh;
  VoxelGrid grid;
  std::vector<VoxelFragment> fragments;  ///< what the quads were made from, original patch by original patch
};

/// Simplifies the patches of a mesh, with their reflectance and emission as they are in the mesh, to about
/// `wanted` quads: one for each cell of a grid and each of the six directions in which something in it looks.
/// So the sides of a thin wall, and walls that meet in a corner, stay apart. Grids are searched by bisection
/// of the edge of a cell; the result has the nearer number of quads of two neighbouring grids, one with fewer
/// than wanted and one with more (or the one cell or the grid that has exactly so many).
///
/// What it does not keep: where a cell cuts other than rectangles out of a curved or sloped surface, its
/// quads do not meet, and where surfaces of different offset that look the same way share a cell, their quad
/// stands between them. Light passes through the gaps, as wide as a cell at most, and is absorbed on the
/// backs or lost. Axis-aligned walls leak nothing. Where the original is an enclosure, so is the result
/// (topology.enclosure, though the quads may not be closed): what leaks out counts as arrived, and the
/// symmetric closure of form factors brings it back.
///
/// Throws UsageError for wanted < 1 and for more quads than a grid of 2^20 cells each way can have.
SimplifiedScene simplify_to_voxels(const PatchMesh& mesh, Index wanted);

/// The same with the grid given.
SimplifiedScene simplify_to_voxels(const PatchMesh& mesh, const VoxelGrid& grid);

}  // namespace radiosity

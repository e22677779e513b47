#pragma once

#include "scene/voxel_fragments.hpp"

#include <Eigen/Core>

#include <vector>

namespace radiosity {

/// What stands for all fragments of one cell that look in one of the six directions: an axis-aligned
/// rectangle.
///
/// It lies at their area-weighted offset. Let P be their area projected along the direction and |R| that of
/// the rectangle around the projection: the quad is R if the fragments fill it (P >= |R|), else R shrunk
/// about their centroid to the area P (a triangle). So it stays in its cell, quads of different cells never
/// overlap, and an axis-aligned wall becomes itself, without gap or overlap. What a single layer of surface
/// blocks and receives along the axis is conserved; a slope loses area, by a factor of sqrt(3) at most, and
/// of layers behind each other one is left. (Quads stretched along the slope to the true area were tried:
/// they reach into each other and made the indirect light of most rooms worse.) Power is conserved in any
/// case: the emission is sum A E over the area of the quad. The reflectance is the mean weighted by true
/// area.
///
/// The two directions of one axis may swap places by averaging, so that what was a wall seen from both sides
/// would be a slit seen from within: such pairs (fragments of both lie among each other, the quads face each
/// other within a tenth of a cell), and slits below a thousandth of a cell, become a sheet in their common
/// plane.
struct VoxelQuad {
  Polygon corners;                 ///< 4, counter-clockwise seen from the front
  Eigen::RowVectorXd reflectance;  ///< 1 x channels, area-weighted mean
  Eigen::RowVectorXd emission;     ///< 1 x channels, W/m^2
  int group = 0;                   ///< the one with most area
  double source_area = 0;          ///< A
};

/// One quad for each occupied cell and direction, in the order of cells and directions. `mesh` is what the
/// fragments were cut from.
std::vector<VoxelQuad> voxel_quads(const PatchMesh& mesh, const VoxelGrid& grid,
                                   const std::vector<VoxelFragment>& fragments);

/// How many these would be.
Index count_quads(const std::vector<VoxelFragment>& fragments);

}  // namespace radiosity

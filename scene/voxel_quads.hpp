#pragma once

#include "scene/voxel_fragments.hpp"

#include <Eigen/Core>

#include <vector>

namespace radiosity {

/// What stands for all fragments of one cell that look in one of the six directions: an axis-aligned
/// rectangle.
///
/// It lies at their area-weighted offset. Let A be their area, P its projection on the plane of the
/// rectangle, and |R| the area of the rectangle around the projection. The rectangle has the area A min(1,
/// |R| / P): R itself where the fragments fill it, shrunk about their centroid where they do not (a
/// triangle), and stretched by A / P along the slope where they are tilted, at most by sqrt(3), so that it
/// reaches into the cells beside it. So area, and with it absorption, is conserved wherever a cell holds a
/// single layer; of layers behind each other one is left. Power is conserved in any case: the emission is sum
/// A E over the area of the rectangle. An axis-aligned wall becomes itself, without gap or overlap.
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

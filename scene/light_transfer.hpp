#pragma once

#include "scene/voxel_simplification.hpp"

#include <Eigen/Core>

namespace radiosity {

/// For each patch of a simplified scene the sum over its fragments of their areas times the field of the
/// patches that they are part of: m x c from n x c. Divided by the areas of the quads it is the emission that
/// has the power of `field` (as in the simplified mesh itself); by the sums of ones, the area-weighted mean.
/// Throws UsageError for another number of rows than the fragments' patches have.
Eigen::MatrixXd sum_over_fragments(const SimplifiedScene& simplified, const PatchMesh& original,
                                   const Eigen::MatrixXd& field);

/// What is known on the patches of a simplified scene, pulled back to each patch of the original that it was
/// made from: the area-weighted mean over the fragments of the patch, each with the GatherWeights of its
/// centroid. A patch smaller than a cell interpolates, a larger one takes the mean of what it became. `field`
/// is m x c for m quads, the result n x c; constants stay constant and results within the range of the field.
/// `original` is the mesh that was simplified. Throws UsageError for another number of rows.
Eigen::MatrixXd pull_back_to_patches(const SimplifiedScene& simplified, const PatchMesh& original,
                                     const Eigen::MatrixXd& field);

/// The same at the corners of each original patch, seen with the patch's normal: 4 n x c, corner k of patch i
/// in row 4 i + k; the fourth row of a triangle is 0.
Eigen::MatrixXd pull_back_to_corners(const SimplifiedScene& simplified, const PatchMesh& original,
                                     const Eigen::MatrixXd& field);

/// B = E + rho H of the original, with its own E and rho, where H is the irradiance of the simplified scene
/// (m x channels, W/m^2) pulled back to the patches, n x channels.
Eigen::MatrixXd radiosity_of_patches(const SimplifiedScene& simplified, const PatchMesh& original,
                                     const Eigen::MatrixXd& irradiance);

/// The same at the corners, 4 n x channels as above.
Eigen::MatrixXd radiosity_of_corners(const SimplifiedScene& simplified, const PatchMesh& original,
                                     const Eigen::MatrixXd& irradiance);

}  // namespace radiosity

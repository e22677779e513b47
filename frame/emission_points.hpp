#pragma once

#include "scene/voxel_simplification.hpp"

#include <Eigen/Core>

namespace radiosity {

/// Where the light that patches receive is measured (document 000, section 3.6, step 2: "square of
/// illuminated part of patch"): as many stratified points on each, patch by patch.
struct EmissionPoints {
  Index per_patch = 0;
  Eigen::Matrix3Xd position;    ///< 3 x (n per_patch), scene units
  Eigen::Matrix3Xd normal;      ///< the same, unit
  Eigen::MatrixXd reflectance;  ///< n x 3: E = reflectance times the mean irradiance of the points
  Eigen::MatrixXd emission;     ///< n x 3, W/m^2, of the patches' own
};

/// A jittered grid of strata x strata on each patch. Throws UsageError for less than one or more than 64.
EmissionPoints emission_points(const PatchMesh& mesh, int strata);

/// For the patches of a simplified scene, points of the original surface: those of the fragments that became
/// a patch, picked by area. A patch has the power that its fragments reflect with its own reflectance.
EmissionPoints emission_points(const SimplifiedScene& simplified, const PatchMesh& original, int strata);

/// Three columns of what has one or three.
Eigen::MatrixXd in_three_columns(const Eigen::MatrixXd& field);

}  // namespace radiosity

#pragma once

#include "scene/patch_mesh.hpp"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace radiosity {

/// A group of the scene and area-weighted means over its patches.
struct GroupSummary {
  std::string name;
  Index patches = 0;
  double area = 0;          ///< m^2
  Eigen::RowVectorXd mean;  ///< of the field asked for, one number a channel
};

/// The groups that have patches, in the scene's order, with the means of a field (n x c).
std::vector<GroupSummary> summarize_groups(const PatchMesh& mesh, const Eigen::MatrixXd& field);

/// "0.5", or "0.7 0.2 0.1": equal channels once.
std::string channel_text(const Eigen::RowVectorXd& values);

}  // namespace radiosity

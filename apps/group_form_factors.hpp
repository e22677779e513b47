#pragma once

#include "form_factors/form_factors.hpp"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace radiosity {

/// F between the groups of a scene that have patches: F_gh is the fraction of what leaves g evenly that
/// arrives at h.
struct GroupFormFactors {
  std::vector<std::string> groups;
  Eigen::VectorXd area;            ///< m^2
  Eigen::MatrixXd matrix;          ///< groups x groups, area-averaged over the patches of the row's group
  Eigen::MatrixXd standard_error;  ///< of the matrix before a closure; empty where it is not known
};

GroupFormFactors group_form_factors(const FormFactors& form_factors);

}  // namespace radiosity

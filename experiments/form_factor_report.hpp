#pragma once

#include "experiments/machine.hpp"
#include "form_factors/form_factors.hpp"

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// F between the groups of a scene, averaged over the area of the sending group:
/// F_gh = sum_{i in g} A_i sum_{j in h} F_ij / A_g.
struct GroupFormFactors {
  std::vector<std::string> names;                 ///< of the groups that have patches, in the scene's order
  Eigen::VectorXd areas;                          ///< m^2
  Eigen::MatrixXd matrix;                         ///< groups x groups
  std::optional<Eigen::MatrixXd> standard_error;  ///< the same shape; empty where none was estimated
};

/// Groups of the scene without patches are left out.
GroupFormFactors group_form_factors(const FormFactors& form_factors);

/// The JSON of `form-factors` (architecture.md): scene, machine, form_factors and, if given, the groups.
/// Appears whole or not at all.
void write_form_factor_json(const std::filesystem::path& file, const FormFactors& form_factors,
                            const Machine& machine,
                            const std::optional<GroupFormFactors>& groups = std::nullopt);

/// Names, areas and F_gh as aligned columns for a terminal, ending with a newline.
std::string group_table(const GroupFormFactors& groups);

}  // namespace radiosity

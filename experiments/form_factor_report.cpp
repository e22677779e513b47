#include "experiments/form_factor_report.hpp"

#include "kernels/products.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace radiosity {

namespace {

/// The groups that have patches, as indices into the scene's groups, rising.
std::vector<Index> groups_in_use(const PatchMesh& mesh) {
  std::vector<bool> used(mesh.scene->groups.size(), false);
  for (const Patch& patch : mesh.patches) used[static_cast<std::size_t>(patch.group)] = true;
  std::vector<Index> groups;
  for (std::size_t g = 0; g < used.size(); ++g)
    if (used[g]) groups.push_back(static_cast<Index>(g));
  return groups;
}

/// Y = F X.
Eigen::MatrixXd multiply_form_factors(const FormFactors& form_factors, const Eigen::MatrixXd& X) {
  Eigen::MatrixXd Y(X.rows(), X.cols());
  if (!form_factors.symmetric()) {
    multiply(*form_factors.unsymmetric, X, Y);
    return Y;
  }
  const Eigen::VectorXd root_area = form_factors.mesh->area.cwiseSqrt();
  multiply(*form_factors.kernel, root_area.asDiagonal() * X, Y);
  return root_area.cwiseInverse().asDiagonal() * Y;
}

}  // namespace

GroupFormFactors group_form_factors(const FormFactors& form_factors) {
  const PatchMesh& mesh = *form_factors.mesh;
  const std::vector<Index> used = groups_in_use(mesh);
  Eigen::MatrixXd members = Eigen::MatrixXd::Zero(mesh.patch_count(), static_cast<Index>(used.size()));
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const auto place =
        std::lower_bound(used.begin(), used.end(), mesh.patches[static_cast<std::size_t>(i)].group);
    members(i, place - used.begin()) = 1;
  }
  GroupFormFactors groups;
  for (const Index g : used) groups.names.push_back(mesh.scene->groups[static_cast<std::size_t>(g)]);
  groups.areas = members.transpose() * mesh.area;
  const Eigen::MatrixXd received = mesh.area.asDiagonal() * multiply_form_factors(form_factors, members);
  groups.matrix = groups.areas.cwiseInverse().asDiagonal() * (members.transpose() * received);
  if (form_factors.group_standard_error.size() > 0)
    groups.standard_error = form_factors.group_standard_error(used, used);
  return groups;
}

std::string group_table(const GroupFormFactors& groups) {
  std::size_t width = 5;
  for (const std::string& name : groups.names) width = std::max(width, name.size());
  std::string table = fmt::format("{:{}}  {:>12}", "group", width, "area");
  for (const std::string& name : groups.names) table += fmt::format("  {:>10}", name);
  table += '\n';
  for (Index g = 0; g < groups.matrix.rows(); ++g) {
    table +=
        fmt::format("{:{}}  {:12.6g}", groups.names[static_cast<std::size_t>(g)], width, groups.areas[g]);
    for (Index h = 0; h < groups.matrix.cols(); ++h)
      table += fmt::format("  {:{}.6f}", groups.matrix(g, h),
                           std::max<std::size_t>(10, groups.names[static_cast<std::size_t>(h)].size()));
    table += '\n';
  }
  return table;
}

}  // namespace radiosity

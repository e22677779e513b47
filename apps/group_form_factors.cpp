#include "apps/group_form_factors.hpp"

#include "kernels/products.hpp"

#include <cstddef>

namespace radiosity {
namespace {

/// The groups that have patches.
std::vector<Index> used_groups(const PatchMesh& mesh) {
  std::vector<bool> used(mesh.scene->groups.size(), false);
  for (const Patch& patch : mesh.patches) used[static_cast<std::size_t>(patch.group)] = true;
  std::vector<Index> groups;
  for (std::size_t g = 0; g < used.size(); ++g)
    if (used[g]) groups.push_back(static_cast<Index>(g));
  return groups;
}

/// n x groups: 1 where the patch of the row belongs to the group of the column.
Eigen::MatrixXd membership(const PatchMesh& mesh, const std::vector<Index>& groups) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(mesh.patch_count(), static_cast<Index>(groups.size()));
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (Index i = 0; i < mesh.patch_count(); ++i)
      if (mesh.patches[static_cast<std::size_t>(i)].group == groups[g]) result(i, static_cast<Index>(g)) = 1;
  return result;
}

}  // namespace

GroupFormFactors group_form_factors(const FormFactors& form_factors) {
  const PatchMesh& mesh = *form_factors.mesh;
  const std::vector<Index> groups = used_groups(mesh);
  const Eigen::MatrixXd members = membership(mesh, groups);

  GroupFormFactors result;
  for (const Index group : groups)
    result.groups.push_back(mesh.scene->groups[static_cast<std::size_t>(group)]);
  result.area = members.transpose() * mesh.area;

  Eigen::MatrixXd exchange;  // sum over i in g and j in h of A_i F_ij
  Eigen::MatrixXd product(members.rows(), members.cols());
  if (form_factors.symmetric()) {
    const Eigen::MatrixXd weighted = mesh.area.cwiseSqrt().asDiagonal() * members;
    multiply(*form_factors.kernel, weighted, product);
    exchange = weighted.transpose() * product;
  } else {
    multiply(*form_factors.unsymmetric, members, product);
    exchange = members.transpose() * (mesh.area.asDiagonal() * product);
  }
  result.matrix = result.area.cwiseInverse().asDiagonal() * exchange;
  if (form_factors.group_standard_error.size() > 0)
    result.standard_error = form_factors.group_standard_error(groups, groups);
  return result;
}

}  // namespace radiosity

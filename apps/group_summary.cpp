#include "apps/group_summary.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <utility>

namespace radiosity {

std::vector<GroupSummary> summarize_groups(const PatchMesh& mesh, const Eigen::MatrixXd& field) {
  std::vector<GroupSummary> groups(mesh.scene->groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    groups[g].name = mesh.scene->groups[g];
    groups[g].mean = Eigen::RowVectorXd::Zero(field.cols());
  }
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    GroupSummary& group = groups[static_cast<std::size_t>(mesh.patches[static_cast<std::size_t>(i)].group)];
    ++group.patches;
    group.area += mesh.area[i];
    group.mean += mesh.area[i] * field.row(i);
  }
  std::erase_if(groups, [](const GroupSummary& group) { return group.patches == 0; });
  for (GroupSummary& group : groups) group.mean /= group.area;
  return groups;
}

std::string channel_text(const Eigen::RowVectorXd& values) {
  if ((values.array() == values[0]).all()) return fmt::format("{:.5g}", values[0]);
  std::string text;
  for (Index c = 0; c < values.size(); ++c) text += fmt::format("{}{:.4g}", c > 0 ? " " : "", values[c]);
  return text;
}

}  // namespace radiosity

#include "operators/element_partition.hpp"

#include "form_factors/coherent_mesh.hpp"
#include "operators/rooms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace radiosity {

ElementPartition::ElementPartition(std::vector<int> patch_of_element, const Eigen::VectorXd& area)
    : patch_of_element_(std::move(patch_of_element)) {
  const Index k = patch_of_element_.empty()
                      ? 0
                      : *std::max_element(patch_of_element_.begin(), patch_of_element_.end()) + 1;
  offsets_.assign(static_cast<std::size_t>(k) + 1, 0);
  for (const int p : patch_of_element_) ++offsets_[static_cast<std::size_t>(p) + 1];
  for (std::size_t p = 0; p < static_cast<std::size_t>(k); ++p) offsets_[p + 1] += offsets_[p];

  order_.resize(patch_of_element_.size());
  std::vector<Index> next(offsets_.begin(), offsets_.end() - 1);
  patch_area_ = Eigen::VectorXd::Zero(k);
  for (Index e = 0; e < elements(); ++e) {
    const auto p = static_cast<std::size_t>(patch_of_element_[static_cast<std::size_t>(e)]);
    order_[static_cast<std::size_t>(next[p]++)] = e;
    patch_area_[static_cast<Index>(p)] += area[e];
  }
  constexpr double rounding = 1e-12;
  for (Index e = 0; e < elements(); ++e) {
    const auto p = static_cast<std::size_t>(patch_of_element_[static_cast<std::size_t>(e)]);
    const double first = area[order_[static_cast<std::size_t>(offsets_[p])]];
    equal_areas_ = equal_areas_ && std::fabs(area[e] - first) <= rounding * first;
  }
}

PartitionChoice PartitionChoice::take(Spec& spec) {
  PartitionChoice choice;
  choice.patches = spec.integer("k", choice.patches, 1, 1 << 24);
  const std::string mesh = spec.choice("mesh", "adaptive", {"adaptive", "uniform"});
  choice.adaptive = mesh == "adaptive";
  const std::string assign = spec.choice("assign", "inclusion", {"inclusion", "proximity"});
  choice.assignment = assign == "inclusion" ? Assignment::inclusion : Assignment::proximity;
  choice.text = fmt::format("k={},mesh={},assign={}", choice.patches, mesh, assign);
  if (choice.adaptive) {
    choice.threshold = spec.number("threshold", 0, 0, 1);
    choice.least_area = spec.number("least-area", 0, 0, 1e300);
    if (choice.threshold > 0) choice.text += fmt::format(",threshold={}", choice.threshold);
    if (choice.least_area > 0) choice.text += fmt::format(",least-area={}", choice.least_area);
  }
  return choice;
}

std::optional<CoarseMesh> make_coarse_mesh(const PatchMesh& elements, const PartitionChoice& choice) {
  if (!choice.adaptive) return uniform_coarse_mesh(elements, choice.patches, choice.assignment);
  CoherentMeshOptions options;
  options.threshold = choice.threshold;
  options.least_area = choice.least_area;
  return coherent_coarse_mesh(elements, choice.patches, choice.assignment, options);
}

ChosenPartition choose_partition(const FormFactors& form_factors, const PartitionChoice& choice) {
  const PatchMesh& mesh = *form_factors.mesh;
  if (std::optional<CoarseMesh> coarse = make_coarse_mesh(mesh, choice))
    return {ElementPartition(std::move(coarse->patch_of_element), mesh.area), {}};
  const Rooms everything{std::vector<int>(mesh.patches.size(), 0), mesh.patches.empty() ? 0 : 1};
  Rooms sets = divide_rooms(form_factors, everything,
                            static_cast<int>(std::min(choice.patches, form_factors.patch_count())));
  return {
      ElementPartition(std::move(sets.of_patch), mesh.area),
      fmt::format("the scene has no coarse mesh of at most {} patches: its elements are in {} compact sets",
                  choice.patches, sets.count)};
}

}  // namespace radiosity

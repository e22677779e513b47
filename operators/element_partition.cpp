#include "operators/element_partition.hpp"

#include "form_factors/coherent_mesh.hpp"
#include "operators/rooms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace radiosity {

ElementPartition::ElementPartition(std::vector<std::int32_t> patch_of_element, Eigen::VectorXd area)
    : patch_of_element_(std::move(patch_of_element)), element_area_(std::move(area)) {
  const Index k = patch_of_element_.empty()
                      ? 0
                      : *std::max_element(patch_of_element_.begin(), patch_of_element_.end()) + 1;
  patch_area_ = Eigen::VectorXd::Zero(k);
  Eigen::VectorXd first = Eigen::VectorXd::Zero(k);
  constexpr double rounding = 1e-12;
  for (Index e = 0; e < elements(); ++e) {
    const Index p = patch_of_element_[static_cast<std::size_t>(e)];
    if (first[p] == 0) first[p] = element_area_[e];
    patch_area_[p] += element_area_[e];
    equal_areas_ = equal_areas_ && std::fabs(element_area_[e] - first[p]) <= rounding * first[p];
  }
}

Eigen::VectorXd ElementPartition::divisors() const {
  if (!equal_areas_) return patch_area_;
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(patches());
  for (const std::int32_t p : patch_of_element_) ++counts[p];
  return counts;
}

Segments ElementPartition::sorted(const std::vector<double>& weights) const {
  Segments segments = sort_by_segment(patch_of_element_, patches(), weights);
  // Elements that come patch by patch need no permutation.
  if (!std::is_sorted(patch_of_element_.begin(), patch_of_element_.end())) return segments;
  return Segments(segments.offsets(), segments.weights());
}

Segments ElementPartition::right_factor() const {
  if (equal_areas_) return sorted({});
  return sorted({element_area_.begin(), element_area_.end()});
}

Segments ElementPartition::orthonormal_indicators() const {
  std::vector<double> weights;
  weights.reserve(patch_of_element_.size());
  for (Index e = 0; e < elements(); ++e)
    weights.push_back(
        std::sqrt(element_area_[e] / patch_area_[patch_of_element_[static_cast<std::size_t>(e)]]));
  return sorted(weights);
}

PartitionChoice PartitionChoice::take(Spec& spec) {
  PartitionChoice choice;
  choice.patches = spec.integer("k", choice.patches, 1, 1 << 24);
  const std::string mesh = spec.choice("mesh", "adaptive", {"adaptive", "uniform"});
  choice.adaptive = mesh == "adaptive";
  const std::string assign = spec.choice("assign", "inclusion", {"inclusion", "proximity"});
  choice.assignment = assign == "inclusion" ? Assignment::inclusion : Assignment::proximity;
  choice.text = fmt::format("mesh={},assign={}", mesh, assign);
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
  if (mesh.patch_count() <= choice.patches) {
    std::vector<std::int32_t> each(mesh.patches.size());
    std::iota(each.begin(), each.end(), 0);
    return {ElementPartition(std::move(each), mesh.area), {}};
  }
  if (std::optional<CoarseMesh> coarse = make_coarse_mesh(mesh, choice))
    return {ElementPartition(std::move(coarse->patch_of_element), mesh.area), {}};
  const Rooms everything{std::vector<int>(mesh.patches.size(), 0), 1};
  Rooms sets = divide_rooms(form_factors, everything, static_cast<int>(choice.patches));
  return {
      ElementPartition(std::move(sets.of_patch), mesh.area),
      fmt::format("the scene has no coarse mesh of at most {} patches: its elements are in {} compact sets",
                  choice.patches, sets.count)};
}

}  // namespace radiosity

#include "frame/patch_emission.hpp"

#include "frame/device_lists.hpp"

namespace radiosity {
namespace {

constexpr unsigned points_binding = 0;
constexpr unsigned reflectance_binding = 1;
constexpr unsigned own_emission_binding = 2;
constexpr unsigned written_emission_binding = 3;
constexpr int invocations_of_emission_group = 64;

/// Position and normal of each point, four numbers each.
std::vector<float> point_list(const EmissionPoints& points, const Vector3& origin) {
  Eigen::MatrixXf list = Eigen::MatrixXf::Zero(8, points.position.cols());
  list.topRows<3>() = (points.position.colwise() - origin).cast<float>();
  list.middleRows<3>(4) = points.normal.cast<float>();
  return {list.data(), list.data() + list.size()};
}

}  // namespace

PatchEmission::PatchEmission(const std::shared_ptr<GlDevice>& device, const EmissionPoints& points,
                             const Vector3& origin)
    : patches_(points.reflectance.rows()),
      points_of_patch_(points.per_patch),
      lanes_(device->preferred_strategy() == RowStrategy::group ? 32 : 1),
      program_(&device->program({"patch_emission.comp", {{"LANES", lanes_}}})),
      points_(device_list(device->context(), point_list(points, origin))),
      reflectance_(device_columns(device->context(), points.reflectance)),
      own_(device_columns(device->context(), points.emission)) {}

void PatchEmission::compute(const ResidentTransport& transport) const {
  points_.bind(points_binding);
  reflectance_.bind(reflectance_binding);
  own_.bind(own_emission_binding);
  transport.emission().buffer().bind(written_emission_binding);
  program_->use();
  program_->set("patches", patches_);
  program_->set("stride", transport.emission().stride());
  program_->set("points_of_patch", points_of_patch_);
  const Index patches_together = invocations_of_emission_group / lanes_;
  program_->dispatch((patches_ + patches_together - 1) / patches_together);
}

}  // namespace radiosity

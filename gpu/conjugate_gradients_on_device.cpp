#include "gpu/conjugate_gradients_on_device.hpp"

namespace radiosity {
namespace {

constexpr unsigned direction_binding = 3;
constexpr unsigned image_binding = 4;
constexpr unsigned solution_binding = 5;
constexpr unsigned residual_binding = 6;
/// Where the shader that updates reads the step's length, and the one after it the weight of the direction.
constexpr unsigned length_binding = 1;
constexpr unsigned conjugation_binding = 2;

/// S = R^{1/2} K R^{1/2}.
DeviceTransport symmetric_form(const DeviceTransport& on_device, const KernelOperator& original) {
  const Eigen::ArrayXXd root = original.reflectance().array().sqrt();
  return {on_device.matrix, root, root, on_device.order};
}

}  // namespace

ConjugateGradientsOnDevice::ConjugateGradientsOnDevice(const DeviceTransport& on_device,
                                                       const KernelOperator& original,
                                                       std::optional<RowStrategy> strategy)
    : DeviceIteration(symmetric_form(on_device, original), original.root_area(), strategy),
      root_reflectance_(original.reflectance().array().sqrt()) {
  const CurrentContext current(*device().context());
  image_ = &fields_program("cg_image.comp", 1);
  step_length_ = &device().program({"column_scalars.comp", {{"SUMS", 1}, {"STAGE", 1}}});
  update_ = &fields_program("cg_update.comp", 2);
  conjugation_ = &device().program({"column_scalars.comp", {{"SUMS", 2}, {"STAGE", 2}}});
  direction_ = &fields_program("cg_direction.comp", 0);
}

void ConjugateGradientsOnDevice::reserve(Index columns) {
  fields_.reset();
  fields_.emplace(Fields{new_field(columns), new_field(columns), new_field(columns), new_field(columns),
                         new_field(columns), new_field(columns)});
}

void ConjugateGradientsOnDevice::begin(const Field& R) {
  fields_->x.write(sorted(root_area().asDiagonal() * R));
  fields_->direction.clear();
  fields_->solution.clear();
  fields_->residual.clear();
  iterate(true);
}

void ConjugateGradientsOnDevice::iterate(bool starting) const {
  multiply(fields_->x, fields_->y);
  fields_->y.buffer().bind(FieldBuffers::y_binding);
  fields_->direction.buffer().bind(direction_binding);
  fields_->image.buffer().bind(image_binding);
  fields_->solution.buffer().bind(solution_binding);
  fields_->residual.buffer().bind(residual_binding);
  run_on_fields(*image_);
  reduce(*step_length_, starting);
  bind_scalars(length_binding);
  run_on_fields(*update_);
  reduce(*conjugation_, starting);
  fields_->x.buffer().bind(FieldBuffers::x_binding);
  bind_scalars(conjugation_binding);
  run_on_fields(*direction_);
}

Field ConjugateGradientsOnDevice::result(const Field& R) const {
  const Eigen::ArrayXXd reflected =
      root_reflectance_.replicate(1, R.cols() / channels()) * by_patch(fields_->solution.read()).array();
  return R.array() + reflected.colwise() / root_area().array();
}

}  // namespace radiosity

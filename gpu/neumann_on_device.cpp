#include "gpu/neumann_on_device.hpp"

namespace radiosity {
namespace {

constexpr unsigned emission_binding = 3;
constexpr unsigned radiosity_binding = 4;

}  // namespace

NeumannOnDevice::NeumannOnDevice(const DeviceTransport& transport, const Eigen::VectorXd& root_areas,
                                 std::optional<RowStrategy> strategy)
    : DeviceIteration(transport, root_areas, strategy) {
  const CurrentContext current(*device().context());
  step_ = &fields_program("neumann_step.comp", 1);
  norms_ = &device().program({"column_scalars.comp", {{"SUMS", 1}, {"STAGE", 0}}});
}

Eigen::ArrayXXd NeumannOnDevice::weight() const {
  return root_area().replicate(1, channels());
}

void NeumannOnDevice::reserve(Index columns) {
  fields_.reset();
  fields_.emplace(Fields{new_field(columns), new_field(columns), new_field(columns), new_field(columns)});
}

void NeumannOnDevice::begin(const Field& R) {
  fields_->emission.write(sorted(R));
  fields_->radiosity.clear();
  fields_->y.clear();
  bounce();  // of no light: D = R
}

void NeumannOnDevice::step() {
  multiply(fields_->x, fields_->y);
  bounce();
}

void NeumannOnDevice::bounce() const {
  fields_->x.buffer().bind(FieldBuffers::x_binding);
  fields_->y.buffer().bind(FieldBuffers::y_binding);
  fields_->emission.buffer().bind(emission_binding);
  fields_->radiosity.buffer().bind(radiosity_binding);
  run_on_fields(*step_);
  reduce(*norms_, false);
}

Field NeumannOnDevice::result(const Field& /*R*/) const {
  return by_patch(fields_->radiosity.read());
}

}  // namespace radiosity

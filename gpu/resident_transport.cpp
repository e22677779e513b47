#include "gpu/resident_transport.hpp"

#include "foundation/error.hpp"
#include "gpu/field_buffers.hpp"

#include <algorithm>
#include <epoxy/gl.h>
#include <optional>
#include <utility>

namespace radiosity {
namespace {

constexpr unsigned step_diagonals_binding = 0;
constexpr unsigned places_binding = 3;
constexpr unsigned step_emission_binding = 4;
constexpr unsigned irradiance_binding = 5;
constexpr Index patches_of_step_group = 64;

ResidentProduct require_product(const LinearOperator& transport) {
  std::optional<ResidentProduct> product = resident_product(transport);
  if (!product)
    fail<UsageError>(
        "{} cannot take fields that are on the device already: use an operator that runs there as a whole, "
        "in float32, "
        "without a closure (closure=none; form factors are closed before)",
        transport.describe());
  return *std::move(product);
}

}  // namespace

ResidentTransport::ResidentTransport(std::shared_ptr<GlDevice> device, const LinearOperator& transport,
                                     int products)
    : device_(std::move(device)), n_(transport.size()) {
  const ResidentProduct product = require_product(transport);
  if (products < 1) fail<UsageError>("{} products a frame are too few: at least one is needed", products);
  products_ = product.global ? 1 : products;
  const CurrentContext current(*device_->context());
  for (auto* field : {&emission_, &irradiance_, &x_, &y_}) field->emplace(device_->context(), n_, colours);
  diagonals_.emplace(device_->context(), n_, 3 * colours);

  Index slot = 0;
  for (const ResidentProduct::Part& part : product.parts) {
    const Index first = slot;
    for (Index colour = 0; colour < colours; ++colour) {
      const Index channel = colour % transport.channels();
      if (std::find(part.channels.begin(), part.channels.end(), channel) == part.channels.end()) continue;
      slots_ |= slot << (2 * colour);
      ++slot;
    }
    parts_.push_back({part.matrix, first, slot - first});
  }
  upload_diagonals(product);
  upload_places(product.order);
  first_ = &device_->program({"transport_step.comp", {{"FIRST", 1}}});
  later_ = &device_->program({"transport_step.comp", {{"FIRST", 0}}});
  device_->context()->check("preparing the transport of frames");
}

/// Columns before, after and reflectance, three each; the scale of the stored numbers goes into `after`.
void ResidentTransport::upload_diagonals(const ResidentProduct& product) {
  Field columns(n_, 3 * colours);
  const Index channels = product.before.cols();
  for (Index colour = 0; colour < colours; ++colour) {
    const Index channel = colour % channels;
    double scale = 1;
    for (const ResidentProduct::Part& part : product.parts)
      if (std::find(part.channels.begin(), part.channels.end(), channel) != part.channels.end())
        scale = part.matrix->scale();
    columns.col(colour) = product.before.col(channel);
    columns.col(colours + colour) = scale * product.after.col(channel);
    columns.col(2 * colours + colour) = product.reflectance.col(channel);
  }
  diagonals_->write(columns);
}

void ResidentTransport::upload_places(const std::vector<Index>& order) {
  std::vector<std::uint32_t> places(static_cast<std::size_t>(std::max<Index>(n_, 1)));
  for (std::size_t place = 0; place < places.size(); ++place) {
    const std::size_t patch = order.empty() ? place : static_cast<std::size_t>(order[place]);
    places[patch] = static_cast<std::uint32_t>(place);
  }
  places_ = std::make_unique<GlBuffer>(device_->context(), places.size() * sizeof(std::uint32_t));
  places_->write(0, places_->bytes(), places.data());
}

void ResidentTransport::run() const {
  if (n_ == 0) return;
  step(*first_);
  for (int product = 0; product < products_; ++product) {
    multiply();
    step(*later_);
  }
}

/// H from Y, and X of the next product from E + R H.
void ResidentTransport::step(const GlProgram& program) const {
  diagonals_->buffer().bind(step_diagonals_binding);
  x_->buffer().bind(FieldBuffers::x_binding);
  y_->buffer().bind(FieldBuffers::y_binding);
  places_->bind(places_binding);
  emission_->buffer().bind(step_emission_binding);
  irradiance_->buffer().bind(irradiance_binding);
  program.use();
  program.set("patches", n_);
  program.set("stride", x_->stride());
  program.set("slots", slots_);
  program.dispatch((n_ + patches_of_step_group - 1) / patches_of_step_group);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void ResidentTransport::multiply() const {
  const auto column_bytes = static_cast<std::size_t>(x_->stride()) * sizeof(float);
  for (const Part& part : parts_) {
    const std::size_t offset = static_cast<std::size_t>(part.first_slot) * column_bytes;
    const std::size_t bytes = static_cast<std::size_t>(part.slots) * column_bytes;
    x_->buffer().bind_range(FieldBuffers::x_binding, offset, bytes);
    y_->buffer().bind_range(FieldBuffers::y_binding, offset, bytes);
    part.matrix->multiply_bound(part.slots);
  }
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace radiosity

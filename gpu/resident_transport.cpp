#include "gpu/resident_transport.hpp"

#include "foundation/error.hpp"

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

std::unique_ptr<GlBuffer> zeros(const std::shared_ptr<const GlContext>& context, Index numbers) {
  const std::vector<float> zero(static_cast<std::size_t>(numbers), 0);
  auto buffer = std::make_unique<GlBuffer>(context, zero.size() * sizeof(float));
  buffer->write(0, buffer->bytes(), zero.data());
  return buffer;
}

ResidentProduct require_product(const LinearOperator& transport) {
  const auto* on_device = dynamic_cast<const OnDevice*>(&transport);
  std::optional<ResidentProduct> product =
      on_device != nullptr ? on_device->resident_product() : std::nullopt;
  if (!product)
    fail<UsageError>(
        "{} cannot take fields that are on the device already: use an operator that runs there as a whole, "
        "without closure= (form factors are closed before)",
        transport.describe());
  return *std::move(product);
}

}  // namespace

ResidentTransport::ResidentTransport(std::shared_ptr<GlDevice> device, const LinearOperator& transport,
                                     int products)
    : device_(std::move(device)), n_(transport.size()), stride_(FieldBuffers::padded(n_)) {
  const ResidentProduct product = require_product(transport);
  if (products < 1) fail<UsageError>("{} products a frame are too few: at least one is needed", products);
  products_ = product.global ? 1 : products;
  const CurrentContext current(*device_->context());
  const Index numbers = colours * std::max(stride_, FieldBuffers::padding);
  constexpr Index diagonals = 3;
  const Index bytes = diagonals * numbers * static_cast<Index>(sizeof(float));
  if (const std::int64_t limit = device_->context()->limits().storage_block_bytes; bytes > limit)
    fail("diagonals of {} patches take {} bytes, and a storage block of '{}' at most {}: use fewer patches",
         n_, bytes, device_->context()->renderer(), limit);
  for (auto* buffer : {&emission_, &irradiance_, &x_, &y_}) *buffer = zeros(device_->context(), numbers);
  diagonals_ = zeros(device_->context(), diagonals * numbers);

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
  Eigen::MatrixXf columns = Eigen::MatrixXf::Zero(stride_, 3 * colours);
  const Index channels = product.before.cols();
  for (Index colour = 0; colour < colours; ++colour) {
    const Index channel = colour % channels;
    double scale = 1;
    for (const ResidentProduct::Part& part : product.parts)
      if (std::find(part.channels.begin(), part.channels.end(), channel) != part.channels.end())
        scale = part.matrix->scale();
    columns.col(colour).head(n_) = product.before.col(channel).cast<float>();
    columns.col(colours + colour).head(n_) = (scale * product.after.col(channel)).cast<float>();
    columns.col(2 * colours + colour).head(n_) = product.reflectance.col(channel).cast<float>();
  }
  if (n_ > 0) diagonals_->write(0, static_cast<std::size_t>(columns.size()) * sizeof(float), columns.data());
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
  diagonals_->bind(step_diagonals_binding);
  x_->bind(FieldBuffers::x_binding);
  y_->bind(FieldBuffers::y_binding);
  places_->bind(places_binding);
  emission_->bind(step_emission_binding);
  irradiance_->bind(irradiance_binding);
  program.use();
  program.set("patches", n_);
  program.set("stride", stride_);
  program.set("slots", slots_);
  program.dispatch((n_ + patches_of_step_group - 1) / patches_of_step_group);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void ResidentTransport::multiply() const {
  const auto column_bytes = static_cast<std::size_t>(stride_) * sizeof(float);
  for (const Part& part : parts_) {
    const std::size_t offset = static_cast<std::size_t>(part.first_slot) * column_bytes;
    const std::size_t bytes = static_cast<std::size_t>(part.slots) * column_bytes;
    x_->bind_range(FieldBuffers::x_binding, offset, bytes);
    y_->bind_range(FieldBuffers::y_binding, offset, bytes);
    part.matrix->multiply_bound(part.slots);
  }
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace radiosity

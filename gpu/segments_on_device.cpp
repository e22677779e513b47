#include "gpu/segments_on_device.hpp"

#include "foundation/error.hpp"
#include "kernels/stored_number.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace radiosity {
namespace {

constexpr unsigned segment_offsets_binding = 0;
constexpr unsigned segment_weights_binding = 3;
constexpr unsigned segment_order_binding = 5;
constexpr Index numbers_of_segment_group = 64;

/// A copy. Throws Error where it takes more than a storage block.
template <typename Number>
GlBuffer buffer_of_list(const std::shared_ptr<GlDevice>& device, const std::vector<Number>& numbers) {
  const CurrentContext current(*device->context());
  const std::size_t bytes = numbers.size() * sizeof(Number);
  const auto limit = static_cast<std::size_t>(device->context()->limits().storage_block_bytes);
  if (bytes > limit)
    fail("a list of {} bytes is larger than a storage block of '{}', {}: use --device cpu", bytes,
         device->context()->renderer(), limit);
  GlBuffer buffer(device->context(), std::max(bytes, sizeof(Number)));
  if (bytes > 0) buffer.write(0, bytes, numbers.data());
  return buffer;
}

}  // namespace

std::shared_ptr<const GlBuffer> order_on_device(const std::shared_ptr<GlDevice>& device, const Segments& V) {
  if (V.order().empty()) return nullptr;
  return std::make_shared<const GlBuffer>(buffer_of_list(device, V.order()));
}

SegmentsOnDevice::SegmentsOnDevice(std::shared_ptr<GlDevice> device, const Segments& V,
                                   std::shared_ptr<const GlBuffer> order, RowStrategy strategy,
                                   bool in_double)
    : device_(std::move(device)),
      rows_(V.rows()),
      count_(V.count()),
      in_double_(in_double),
      offsets_(buffer_of_list(device_, std::vector<std::uint32_t>(V.offsets().begin(), V.offsets().end()))),
      order_(std::move(order)),
      lanes_(strategy == RowStrategy::group ? numbers_of_segment_group : 1),
      segment_sums_("segment_sums.comp", {{"ORDERED", order_ != nullptr ? 1 : 0},
                                          {"WEIGHTED", V.weights().empty() ? 0 : 1},
                                          {"LANES", static_cast<int>(lanes_)},
                                          {"DOUBLE", in_double ? 1 : 0}}) {
  if (V.weights().empty()) return;
  if (in_double_)
    upload_weights<double>(V.weights());
  else
    upload_weights<float>(V.weights());
}

template <typename Number>
void SegmentsOnDevice::upload_weights(const std::vector<double>& weights) {
  double largest = 0;
  for (const double weight : weights) largest = std::max(largest, std::fabs(weight));
  weight_scale_ = storage_scale<Number>(largest);
  std::vector<Number> stored;
  stored.reserve(weights.size());
  for (const double weight : weights) stored.push_back(static_cast<Number>(weight / weight_scale_));
  weights_.emplace(buffer_of_list(device_, stored));
}

ByteCount SegmentsOnDevice::bytes() const {
  ByteCount bytes{{{"offsets", offsets_.bytes()}}};
  if (order_ != nullptr) bytes.parts.emplace_back("permutation", order_->bytes());
  if (weights_) bytes.parts.emplace_back("areas", weights_->bytes());
  return bytes;
}

void SegmentsOnDevice::multiply(Index columns) const {
  offsets_.bind(segment_offsets_binding);
  if (order_ != nullptr) order_->bind(segment_order_binding);
  if (weights_) weights_->bind(segment_weights_binding);
  segment_sums_.for_columns(*device_, columns, [&](const GlProgram& program, Index first_column) {
    program.set("segments", count_);
    program.set("x_stride", FieldBuffers::padded(rows_));
    program.set("sum_stride", FieldBuffers::padded(count_));
    program.set("first_column", first_column);
    program.dispatch((count_ * lanes_ + numbers_of_segment_group - 1) / numbers_of_segment_group);
  });
}

}  // namespace radiosity

#include "gpu/sparse_v_on_device.hpp"

#include "foundation/error.hpp"
#include "kernels/stored_number.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace radiosity {
namespace {

constexpr unsigned segment_offsets_binding = 0;
constexpr unsigned segment_weights_binding = 3;
constexpr Index numbers_of_segment_group = 64;

/// A copy of 4-byte numbers. Throws Error where they take more than a storage block.
template <typename Number>
GlBuffer buffer_of_list(const std::shared_ptr<GlDevice>& device, const std::vector<Number>& numbers) {
  static_assert(sizeof(Number) == 4);
  const CurrentContext current(*device->context());
  const std::size_t bytes = numbers.size() * sizeof(Number);
  const auto limit = static_cast<std::size_t>(device->context()->limits().storage_block_bytes);
  if (bytes > limit)
    fail("a list of {} bytes is larger than a storage block of '{}', {}: use --device cpu", bytes,
         device->context()->renderer(), limit);
  GlBuffer buffer(device->context(), std::max<std::size_t>(bytes, 4));
  if (bytes > 0) buffer.write(0, bytes, numbers.data());
  return buffer;
}

}  // namespace

SparseVOnDevice::SparseVOnDevice(std::shared_ptr<GlDevice> device_of_factors, const TallMatrix<float>& U,
                                 const Segments& V, RowStrategy strategy)
    : FactorsOnDevice(device_of_factors, U.rows(), U.columns()),
      left_(device_of_factors, U, strategy, !V.order().empty()),
      offsets_(buffer_of_list(device_of_factors,
                              std::vector<std::uint32_t>(V.offsets().begin(), V.offsets().end()))),
      lanes_(strategy == RowStrategy::group ? numbers_of_segment_group : 1),
      segment_sums_("segment_sums.comp", {{"ORDERED", V.order().empty() ? 0 : 1},
                                          {"WEIGHTED", V.weights().empty() ? 0 : 1},
                                          {"LANES", static_cast<int>(lanes_)}}) {
  if (!V.order().empty()) order_.emplace(buffer_of_list(device_of_factors, V.order()));
  if (V.weights().empty()) return;
  double largest = 0;
  for (const double weight : V.weights()) largest = std::max(largest, std::fabs(weight));
  weight_scale_ = storage_scale<float>(largest);
  std::vector<float> weights;
  weights.reserve(V.weights().size());
  for (const double weight : V.weights()) weights.push_back(static_cast<float>(weight / weight_scale_));
  weights_.emplace(buffer_of_list(device_of_factors, weights));
}

std::size_t SparseVOnDevice::right_bytes() const {
  return offsets_.bytes() + (order_ ? order_->bytes() : 0) + (weights_ ? weights_->bytes() : 0);
}

ByteCount SparseVOnDevice::bytes() const {
  ByteCount bytes{{{"U", left_.bytes()}, {"offsets", offsets_.bytes()}}};
  if (order_) bytes.parts.emplace_back("permutation", order_->bytes());
  if (weights_) bytes.parts.emplace_back("areas", weights_->bytes());
  return bytes;
}

void SparseVOnDevice::dispatch_left(Index columns) const {
  if (order_) order_->bind(TallOnDevice::order_binding);
  left_.multiply(columns);
}

void SparseVOnDevice::dispatch_right(Index columns) const {
  offsets_.bind(segment_offsets_binding);
  if (order_) order_->bind(TallOnDevice::order_binding);
  if (weights_) weights_->bind(segment_weights_binding);
  segment_sums_.for_columns(device(), columns, [&](const GlProgram& program, Index first_column) {
    program.set("segments", rank());
    program.set("x_stride", FieldBuffers::padded(cols()));
    program.set("sum_stride", FieldBuffers::padded(rank()));
    program.set("first_column", first_column);
    program.dispatch((rank() * lanes_ + numbers_of_segment_group - 1) / numbers_of_segment_group);
  });
}

}  // namespace radiosity

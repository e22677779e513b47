#include "gpu/device_field.hpp"

#include "foundation/error.hpp"
#include "gpu/field_buffers.hpp"

#include <algorithm>
#include <epoxy/gl.h>
#include <utility>
#include <vector>

namespace radiosity {
namespace {

std::size_t field_bytes(const GlContext& context, Index rows, Index columns) {
  const Index bytes = FieldBuffers::padded(rows) * columns * static_cast<Index>(sizeof(float));
  const std::int64_t limit = context.limits().storage_block_bytes;
  if (bytes > limit)
    fail(
        "a field of {} x {} numbers takes {} bytes, and a storage block of '{}' at most {}: use fewer lights "
        "at a time, fewer patches or --device cpu",
        rows, columns, bytes, context.renderer(), limit);
  return static_cast<std::size_t>(std::max<Index>(bytes, 4));
}

}  // namespace

DeviceField::DeviceField(std::shared_ptr<const GlContext> context, Index rows, Index columns)
    : rows_(rows), columns_(columns), buffer_(context, field_bytes(*context, rows, columns)) {
  clear();
}

Index DeviceField::stride() const {
  return FieldBuffers::padded(rows_);
}

void DeviceField::clear() {
  buffer_.clear();
}

void DeviceField::write(const ConstFieldRef& field) {
  std::vector<float> numbers(static_cast<std::size_t>(stride() * field.cols()), 0);
  for (Index c = 0; c < field.cols(); ++c)
    Eigen::Map<Eigen::VectorXf>(numbers.data() + c * stride(), rows_) = field.col(c).cast<float>();
  if (!numbers.empty()) buffer_.write(0, numbers.size() * sizeof(float), numbers.data());
}

Field DeviceField::read() const {
  std::vector<float> numbers(static_cast<std::size_t>(stride() * columns_));
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  if (!numbers.empty()) buffer_.read(numbers.size() * sizeof(float), numbers.data());
  Field field(rows_, columns_);
  for (Index c = 0; c < columns_; ++c)
    field.col(c) = Eigen::Map<const Eigen::VectorXf>(numbers.data() + c * stride(), rows_).cast<double>();
  return field;
}

}  // namespace radiosity

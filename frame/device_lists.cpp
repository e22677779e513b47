#include "frame/device_lists.hpp"

#include "foundation/error.hpp"

#include <algorithm>

namespace radiosity {
namespace {

GlBuffer copied(const std::shared_ptr<const GlContext>& context, const void* numbers, std::size_t count) {
  constexpr std::size_t number_bytes = 4;
  const std::size_t bytes = std::max<std::size_t>(count, 1) * number_bytes;
  const std::int64_t limit = context->limits().storage_block_bytes;
  if (bytes > static_cast<std::size_t>(limit))
    fail(
        "a list of the frame takes {} bytes, and a storage block of '{}' at most {}: use fewer patches or "
        "fewer points on each",
        bytes, context->renderer(), limit);
  GlBuffer buffer(context, bytes);
  if (count > 0) buffer.write(0, bytes, numbers);
  return buffer;
}

}  // namespace

GlBuffer device_list(const std::shared_ptr<const GlContext>& context, const std::vector<float>& numbers) {
  return copied(context, numbers.data(), numbers.size());
}

GlBuffer device_list(const std::shared_ptr<const GlContext>& context,
                     const std::vector<std::uint32_t>& numbers) {
  return copied(context, numbers.data(), numbers.size());
}

GlBuffer device_columns(const std::shared_ptr<const GlContext>& context, const Eigen::MatrixXd& field) {
  Eigen::MatrixXf columns = Eigen::MatrixXf::Zero(FieldBuffers::padded(field.rows()), field.cols());
  columns.topRows(field.rows()) = field.cast<float>();
  return copied(context, columns.data(), static_cast<std::size_t>(columns.size()));
}

}  // namespace radiosity

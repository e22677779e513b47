#include "gpu/device_matrix.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <epoxy/gl.h>

namespace radiosity {
namespace {

constexpr Index columns_sent_at_most = 64;

/// As many as fit into a storage block, whole sets of `channels` columns. Throws Error if not one does.
Index columns_sent_together(const GlContext& context, Index rows, Index channels, std::size_t number_bytes) {
  const Index set_bytes = FieldBuffers::padded(rows) * channels * static_cast<Index>(number_bytes);
  const std::int64_t limit = context.limits().storage_block_bytes;
  if (set_bytes > limit)
    fail(
        "a field of {} numbers takes {} bytes, and a storage block of '{}' at most {}: use fewer patches or "
        "--device cpu",
        rows * channels, set_bytes, context.renderer(), limit);
  return channels * std::clamp<Index>(limit / set_bytes, 1, columns_sent_at_most / channels);
}

}  // namespace

void DeviceMatrix::multiply(const ConstFieldRef& X, FieldRef Y) const {
  run(X, Y, scale(), [this](Index columns) { dispatch(columns); });
}

void DeviceMatrix::run(const ConstFieldRef& X, FieldRef Y, double scale,
                       const std::function<void(Index columns)>& dispatch_columns) const {
  if (in_double())
    run_in<double>(X, Y, scale, dispatch_columns);
  else
    run_in<float>(X, Y, scale, dispatch_columns);
}

template <typename Number>
void DeviceMatrix::run_in(const ConstFieldRef& X, FieldRef Y, double scale,
                          const std::function<void(Index columns)>& dispatch_columns) const {
  const GlContext& context = *device_->context();
  const CurrentContext current(context);
  const Index together =
      columns_sent_together(context, std::max(X.rows(), Y.rows()), channels(), sizeof(Number));
  for (Index first = 0; first < X.cols(); first += together) {
    const Index columns = std::min(together, X.cols() - first);
    device_->fields().send<Number>(X.middleCols(first, columns), Y.rows());
    {
      const GlTimer::Measurement measurement(device_->timer());
      dispatch_columns(columns);
    }
    device_->fields().receive<Number>(scale, Y.middleCols(first, columns));
    count_device_seconds(device_->timer().seconds());
  }
  context.check("a product");
}

void DeviceMatrix::multiply_on_device(const GlBuffer& X, const GlBuffer& Y, Index columns) const {
  X.bind(FieldBuffers::x_binding);
  Y.bind(FieldBuffers::y_binding);
  dispatch(columns);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace radiosity

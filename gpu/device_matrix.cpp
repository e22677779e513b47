#include "gpu/device_matrix.hpp"

#include <algorithm>

namespace radiosity {
namespace {

constexpr Index columns_sent_together = 64;

}  // namespace

void DeviceMatrix::multiply(const ConstFieldRef& X, FieldRef Y) const {
  run(X, Y, scale(), [this](Index columns) { dispatch(columns); });
}

void DeviceMatrix::run(const ConstFieldRef& X, FieldRef Y, double scale,
                       const std::function<void(Index columns)>& dispatch_columns) const {
  const GlContext& context = *device_->context();
  const CurrentContext current(context);
  for (Index first = 0; first < X.cols(); first += columns_sent_together) {
    const Index columns = std::min(columns_sent_together, X.cols() - first);
    device_->fields().send(X.middleCols(first, columns), Y.rows());
    {
      const GlTimer::Measurement measurement(device_->timer());
      dispatch_columns(columns);
    }
    device_->fields().receive(scale, Y.middleCols(first, columns));
    device_seconds_ = device_seconds_ + device_->timer().seconds();
  }
  context.check("a product");
}

}  // namespace radiosity

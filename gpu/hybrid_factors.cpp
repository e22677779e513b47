#include "gpu/hybrid_factors.hpp"

#include "gpu/device_field.hpp"
#include "gpu/segments_on_device.hpp"
#include "kernels/products.hpp"
#include "kernels/segment_sums.hpp"
#include "kernels/stored_number.hpp"

#include <algorithm>
#include <utility>

namespace radiosity {
namespace {

constexpr Index columns_in_flight = device_columns_at_once;

std::shared_ptr<const GlBuffer> order_of_left(const std::shared_ptr<GlDevice>& device,
                                              const HybridFactors::RightFactor& V) {
  const auto* segments = std::get_if<Segments>(&V);
  return segments == nullptr ? nullptr : order_on_device(device, *segments);
}

/// Coefficients on their way through the device, some columns at a time.
class LeftProduct {
 public:
  LeftProduct(const HybridFactors& factors, Index columns)
      : factors_(factors),
        coefficients_(factors.device().context(), factors.rank(), columns),
        product_(factors.device().context(), factors.rows(), columns) {}

  /// Returns when the device has been told.
  void begin(const ConstFieldRef& C) {
    unit_ = storage_scale<float>(C.size() == 0 ? 0 : C.cwiseAbs().maxCoeff());
    columns_ = C.cols();
    coefficients_.write(C / unit_);
    {
      const GlTimer::Measurement measurement(factors_.device().timer());
      factors_.multiply_on_device(coefficients_.buffer(), product_.buffer(), columns_);
    }
    factors_.device().flush();
  }
  /// Waits for it.
  void end(FieldRef Y) const {
    Y = (unit_ * factors_.scale()) * product_.read().leftCols(columns_);
    factors_.count_device_seconds(factors_.device().timer().seconds());
  }

 private:
  const HybridFactors& factors_;
  double unit_ = 1;
  Index columns_ = 0;
  DeviceField coefficients_;
  DeviceField product_;
};

}  // namespace

HybridFactors::HybridFactors(std::shared_ptr<GlDevice> device_of_left, const TallMatrix<float>& U,
                             RightFactor V, RowStrategy strategy)
    : DeviceMatrix(device_of_left, U.rows(), U.rows()),
      order_(order_of_left(device_of_left, V)),
      left_(device_of_left, U, strategy, order_),
      right_(std::move(V)) {}

void HybridFactors::multiply(const ConstFieldRef& X, FieldRef Y) const {
  if (rank() == 0) {
    Y.setZero();
    return;
  }
  const CurrentContext current(*device().context());
  const Index together = std::min(columns_in_flight, X.cols());
  LeftProduct left(*this, together);
  Field C(rank(), together);
  for (Index first = 0; first < X.cols(); first += together) {
    const Index columns = std::min(together, X.cols() - first);
    multiply_right_transposed(X.middleCols(first, columns), C.leftCols(columns));
    if (first > 0) left.end(Y.middleCols(first - together, together));
    left.begin(C.leftCols(columns));
  }
  const Index last = (X.cols() - 1) / together * together;
  left.end(Y.rightCols(X.cols() - last));
  device().context()->check("a product with factors in two places");
}

void HybridFactors::multiply_left(const ConstFieldRef& C, FieldRef Y) const {
  if (rank() == 0) {
    Y.setZero();
    return;
  }
  const CurrentContext current(*device().context());
  LeftProduct left(*this, C.cols());
  left.begin(C);
  left.end(Y);
}

void HybridFactors::multiply_right_transposed(const ConstFieldRef& X, FieldRef C) const {
  if (const auto* segments = std::get_if<Segments>(&right_))
    segment_sums(*segments, X, C);
  else
    multiply_transposed(std::get<TallMatrix<float>>(right_), X, C);
}

std::size_t HybridFactors::right_bytes() const {
  if (const auto* segments = std::get_if<Segments>(&right_))
    return segments->offset_bytes() + segments->order_bytes() + segments->weight_bytes();
  return std::get<TallMatrix<float>>(right_).entry_bytes();
}

ByteCount HybridFactors::bytes() const {
  return {{{"U", left_.bytes() + (order_ != nullptr ? order_->bytes() : 0)}, {"V", right_bytes()}}};
}

void HybridFactors::dispatch(Index columns) const {
  left_.multiply(columns);
}

}  // namespace radiosity

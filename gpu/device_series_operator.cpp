#include "gpu/device_series_operator.hpp"

#include "operators/reflectance.hpp"

#include <utility>

namespace radiosity {

DeviceSeriesOperator::DeviceSeriesOperator(const Eigen::MatrixXd& reflectance,
                                           std::vector<std::unique_ptr<DeviceMatrix>> series,
                                           Eigen::VectorXd before, DeviceOrigin origin)
    : DeviceOperator(std::move(series), std::move(origin)),
      reflectance_(reflectance),
      reflectances_(reflectance),
      before_(std::move(before)) {}

void DeviceSeriesOperator::apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const {
  const Field scaled = before_.asDiagonal() * X;
  const Field reflected =
      reflectances_.multiply_each(scaled, size(), [&](Index distinct, const Field& fields, FieldRef images) {
        matrix(distinct).multiply(fields, images);
      });
  add_answer(alpha, X, reflected, beta, Y);
}

std::optional<ResidentProduct> DeviceSeriesOperator::resident_product() const {
  ResidentProduct product;
  product.parts = parts_of(reflectances_, channels());
  product.before = before_.replicate(1, channels());
  // S = R H: rows of black patches are zero.
  product.after = reflectance_.unaryExpr([](double rho) { return rho > 0 ? 1 / rho : 0.0; });
  product.reflectance = reflectance_;
  product.global = true;
  return product;
}

}  // namespace radiosity

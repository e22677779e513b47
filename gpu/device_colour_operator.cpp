#include "gpu/device_colour_operator.hpp"

#include "operators/reflectance.hpp"

#include <utility>

namespace radiosity {

DeviceColourOperator::DeviceColourOperator(const ColourOperator& original, Matrices matrices,
                                           DeviceOrigin origin)
    : DeviceOperator(std::move(matrices), std::move(origin)),
      reflectance_(original.reflectance()),
      inverse_colours_(sender_colours(reflectance_).array().inverse()),
      global_(original.global()) {}

void DeviceColourOperator::apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const {
  Field scaled(X.rows(), X.cols());
  add_product(inverse_colours_, X, 0, scaled);
  Field product(X.rows(), X.cols());
  multiply_colours(scaled, product);
  if (!global_) return add_product(alpha * reflectance_.array(), product, beta, Y);
  Field reflected(X.rows(), X.cols());
  add_product(reflectance_.array(), product, 0, reflected);
  add_answer(alpha, X, reflected, beta, Y);
}

ResidentProduct DeviceColourOperator::resident_diagonals() const {
  ResidentProduct product;
  product.before = inverse_colours_;
  product.after = Eigen::MatrixXd::Ones(size(), channels());
  product.reflectance = reflectance_;
  product.global = global_;
  return product;
}

DeviceBouncesOperator::DeviceBouncesOperator(const ColourOperator& original, Matrices sums,
                                             DeviceOrigin origin)
    : DeviceColourOperator(original, std::move(sums), std::move(origin)),
      reflectances_(original.reflectance()) {}

void DeviceBouncesOperator::multiply_colours(const ConstFieldRef& X, FieldRef Y) const {
  Y = reflectances_.multiply_each(X, size(), [&](Index distinct, const Field& fields, FieldRef images) {
    matrix(distinct).multiply(fields, images);
  });
}

std::optional<ResidentProduct> DeviceBouncesOperator::resident_product() const {
  ResidentProduct product = resident_diagonals();
  product.parts = parts_of(reflectances_, channels());
  return product;
}

DeviceTextureOperator::DeviceTextureOperator(const ColourOperator& original,
                                             std::unique_ptr<DeviceMatrix> texture, std::vector<Index> order,
                                             DeviceOrigin origin)
    : DeviceColourOperator(original, only(std::move(texture)), std::move(origin)), order_(std::move(order)) {}

void DeviceTextureOperator::multiply_colours(const ConstFieldRef& X, FieldRef Y) const {
  const Field sorted = X(order_, Eigen::all);
  Field product(X.rows(), X.cols());
  matrix().multiply(sorted, product);
  Y(order_, Eigen::all) = product;
}

std::optional<ResidentProduct> DeviceTextureOperator::resident_product() const {
  ResidentProduct product = resident_diagonals();
  product.parts = {{&matrix(), every_channel(channels())}};
  product.order = order_;
  return product;
}

}  // namespace radiosity

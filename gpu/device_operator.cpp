#include "gpu/device_operator.hpp"

#include "operators/closed_operator.hpp"
#include "operators/reflectance.hpp"
#include "operators/storage_choice.hpp"

#include <utility>

namespace radiosity {

OnDevice::Matrices OnDevice::only(std::unique_ptr<DeviceMatrix> matrix) {
  Matrices matrices;
  matrices.push_back(std::move(matrix));
  return matrices;
}

std::optional<ResidentProduct> resident_product(const LinearOperator& transport) {
  if (const auto* on_device = dynamic_cast<const OnDevice*>(&transport))
    return on_device->in_double() ? std::nullopt : on_device->resident_product();
  const auto* other = dynamic_cast<const StandsForKernel*>(&transport);
  if (other == nullptr) return std::nullopt;
  std::optional<ResidentProduct> product = resident_product(other->kernel_stood_for());
  if (product) product->reflectance = dynamic_cast<const KernelOperator&>(transport).reflectance();
  return product;
}

std::optional<DeviceTransport> transport_on_device(const LinearOperator& transport) {
  const std::optional<ResidentProduct> product = resident_product(transport);
  if (!product || product->global || product->parts.size() > 1) return std::nullopt;
  return DeviceTransport{product->parts.front().matrix, product->reflectance.array() * product->after.array(),
                         product->before.array(), product->order};
}

DeviceUse OnDevice::use() const {
  DeviceUse use = origin_.use;
  for (const auto& matrix : matrices_) use.device_seconds += matrix->device_seconds();
  return use;
}

std::vector<ResidentProduct::Part> OnDevice::parts_of(const DistinctReflectances& reflectances,
                                                      Index channels) const {
  std::vector<ResidentProduct::Part> parts;
  for (Index distinct = 0; distinct < reflectances.count(); ++distinct)
    parts.push_back({&matrix(distinct), {}});
  for (Index channel = 0; channel < channels; ++channel)
    parts[static_cast<std::size_t>(reflectances.of_channel(channel))].channels.push_back(channel);
  return parts;
}

ByteCount OnDevice::bytes_with_diagonals(Index n, Index channels) const {
  ByteCount bytes = matrices_.front()->bytes();
  for (std::size_t other = 1; other < matrices_.size(); ++other) {
    const ByteCount further = matrices_[other]->bytes();
    for (std::size_t part = 0; part < further.parts.size(); ++part)
      bytes.parts[part].second += further.parts[part].second;
  }
  bytes.parts.emplace_back("diagonals", diagonal_bytes(n, channels));
  return bytes;
}

DeviceKernelOperator::DeviceKernelOperator(const KernelOperator& original,
                                           std::unique_ptr<DeviceMatrix> matrix, DeviceOrigin origin,
                                           std::vector<Index> order)
    : DeviceOperator(only(std::move(matrix)), std::move(origin), original.root_area(),
                     original.reflectance()),
      order_(std::move(order)) {}

void DeviceKernelOperator::multiply_kernel(const ConstFieldRef& X, FieldRef Y) const {
  if (order_.empty()) return matrix().multiply(X, Y);
  const Field sorted = X(order_, Eigen::all);
  Field product(X.rows(), X.cols());
  matrix().multiply(sorted, product);
  Y(order_, Eigen::all) = product;
}

std::optional<ResidentProduct> DeviceKernelOperator::resident_product() const {
  ResidentProduct product;
  product.parts = {{&matrix(), every_channel(channels())}};
  product.before = root_area().replicate(1, channels());
  product.after = product.before.cwiseInverse();
  product.reflectance = reflectance();
  product.order = order_;
  return product;
}

DeviceMatrixOperator::DeviceMatrixOperator(const MatrixOperator& original,
                                           std::unique_ptr<DeviceMatrix> matrix, DeviceOrigin origin)
    : DeviceOperator(only(std::move(matrix)), std::move(origin)), reflectance_(original.reflectance()) {}

std::optional<ResidentProduct> DeviceMatrixOperator::resident_product() const {
  ResidentProduct product;
  product.parts = {{&matrix(), every_channel(channels())}};
  product.before = product.after = Eigen::MatrixXd::Ones(size(), channels());
  product.reflectance = reflectance_;
  return product;
}

void DeviceMatrixOperator::apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const {
  Field product(X.rows(), X.cols());
  matrix().multiply(X, product);
  add_product(alpha * reflectance_.array(), product, beta, Y);
}

}  // namespace radiosity

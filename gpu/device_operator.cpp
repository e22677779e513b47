#include "gpu/device_operator.hpp"

#include "operators/reflectance.hpp"
#include "operators/storage_choice.hpp"

#include <utility>

namespace radiosity {

OnDevice::Matrices OnDevice::only(std::unique_ptr<DeviceMatrix> matrix) {
  Matrices matrices;
  matrices.push_back(std::move(matrix));
  return matrices;
}

std::optional<DeviceTransport> OnDevice::transport_on_device() const {
  const std::optional<ResidentProduct> product = resident_product();
  if (!product || product->global || product->parts.size() > 1) return std::nullopt;
  return DeviceTransport{product->parts.front().matrix, product->reflectance.array() * product->after.array(),
                         product->before.array(), product->order};
}

DeviceUse OnDevice::use() const {
  DeviceUse use = origin_.use;
  for (const auto& matrix : matrices_) use.device_seconds += matrix->device_seconds();
  return use;
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
                                           std::unique_ptr<DeviceMatrix> matrix, DeviceOrigin origin)
    : DeviceOperator(only(std::move(matrix)), std::move(origin), original.root_area(),
                     original.reflectance()) {}

std::optional<ResidentProduct> DeviceKernelOperator::resident_product() const {
  ResidentProduct product;
  product.parts = {{&matrix(), every_channel(channels())}};
  product.before = root_area().replicate(1, channels());
  product.after = product.before.cwiseInverse();
  product.reflectance = reflectance();
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

#include "gpu/upload.hpp"

#include "foundation/error.hpp"
#include "foundation/random.hpp"
#include "foundation/spec.hpp"
#include "foundation/stopwatch.hpp"
#include "gpu/dense_on_device.hpp"
#include "gpu/device_operator.hpp"
#include "operators/stored_matrix.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace radiosity {
namespace {

/// Copies what it can and returns null for the rest.
class Uploader {
 public:
  Uploader(const std::shared_ptr<GlDevice>& device, RowStrategy strategy)
      : device_(device), strategy_(strategy) {}

  std::unique_ptr<DeviceMatrix> copy(const LinearOperator& original) const {
    if (const auto* stored = dynamic_cast<const HasStoredMatrix*>(&original))
      return std::visit([this](const auto* matrix) { return copy_stored(*matrix); }, stored->stored());
    return nullptr;
  }

 private:
  using Copy = std::unique_ptr<DeviceMatrix>;

  Copy copy_stored(const SymmetricTiles<float>& kernel) const { return dense(kernel); }
  Copy copy_stored(const SymmetricTiles<Half>& kernel) const { return dense(kernel); }
  Copy copy_stored(const RowMajorMatrix<float>& matrix) const { return dense(matrix); }
  Copy copy_stored(const RowMajorMatrix<Half>& matrix) const { return dense(matrix); }
  /// Double precision is not for the device: few graphics cards are fast at it.
  template <typename Other>
  Copy copy_stored(const Other&) const {
    return nullptr;
  }

  template <template <typename> class Matrix, typename Scalar>
  Copy dense(const Matrix<Scalar>& matrix) const {
    return std::make_unique<DenseOnDevice<Scalar>>(device_, matrix, strategy_);
  }

  std::shared_ptr<GlDevice> device_;
  RowStrategy strategy_;
};

[[noreturn]] void refuse(const std::string& spec) {
  fail<UsageError>("{} cannot run with --device gl; those that can are {}", spec,
                   fmt::join(uploadable_specs(), ", "));
}

std::string spec_on_device(const LinearOperator& original, std::optional<RowStrategy> strategy) {
  if (!strategy) return original.describe();
  return with_keys(original.describe(),
                   *strategy == RowStrategy::group ? "strategy=group" : "strategy=invocation");
}

/// The largest |difference| of a component of a product, relative to the largest component.
double largest_difference(const LinearOperator& original, const LinearOperator& copy) {
  RandomStream random(1);
  const Field X = Field::NullaryExpr(original.size(), original.channels(), [&] { return random.uniform(); });
  Field Y(X.rows(), X.cols());
  Field Z(X.rows(), X.cols());
  original.apply(X, Y);
  copy.apply(X, Z);
  const double largest = Y.size() == 0 ? 0 : Y.cwiseAbs().maxCoeff();
  return largest == 0 ? 0 : (Z - Y).cwiseAbs().maxCoeff() / largest;
}

template <typename Operator, typename Original>
std::unique_ptr<LinearOperator> finish(const Original& original, std::unique_ptr<DeviceMatrix> matrix,
                                       DeviceOrigin origin) {
  const DeviceUse use = origin.use;
  auto copy = std::make_unique<Operator>(original, std::move(matrix), std::move(origin));
  const double difference = largest_difference(original, *copy);
  // Both products are within 2 (n + 8) u |A| |X| of the true one, and nothing is negative but factors.
  const double allowed = 0x1p-24 * 4 * (static_cast<double>(original.size()) + 8);
  if (!(difference <= std::max(allowed, 1e-4)))
    fail("{} on '{}' differs from the CPU's by {:.1e}: its driver computes something else; use --device cpu",
         original.describe(), use.renderer, difference);
  copy->set_difference(difference);
  return copy;
}

}  // namespace

const std::vector<std::string>& uploadable_specs() {
  static const std::vector<std::string> specs = {"dense:f32", "dense:f16"};
  return specs;
}

void require_uploadable(const std::string& spec) {
  const std::string name = Spec::parse(spec).name();
  const auto& specs = uploadable_specs();
  if (std::none_of(specs.begin(), specs.end(),
                   [&](const std::string& known) { return Spec::parse(known).name() == name; }))
    refuse(spec);
}

std::unique_ptr<LinearOperator> upload(const std::shared_ptr<GlDevice>& device,
                                       const LinearOperator& original, std::optional<RowStrategy> strategy) {
  const GlContext& context = *device->context();
  const Stopwatch watch;
  auto matrix = Uploader(device, strategy.value_or(device->preferred_strategy())).copy(original);
  if (!matrix) refuse(original.describe());
  DeviceOrigin origin{spec_on_device(original, strategy), original.remark(), original.certificate(), {}};
  origin.use = {"gl", context.renderer(), context.software(), 0, watch.seconds(), 0};
  if (const auto* kernel = dynamic_cast<const KernelOperator*>(&original))
    return finish<DeviceKernelOperator>(*kernel, std::move(matrix), std::move(origin));
  return finish<DeviceMatrixOperator>(dynamic_cast<const MatrixOperator&>(original), std::move(matrix),
                                      std::move(origin));
}

}  // namespace radiosity

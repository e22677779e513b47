#include "gpu/global_factors.hpp"

#include "gpu/factors_on_device.hpp"
#include "gpu/segments_on_device.hpp"
#include "gpu/tall_right_factor.hpp"
#include "gpu/two_sided_factors.hpp"
#include "operators/sparse_v_operator.hpp"

#include <utility>

namespace radiosity {
namespace {

/// Y V' with a V that another one counts.
class FactorsWithSharedV final : public FactorsOnDevice {
 public:
  using FactorsOnDevice::FactorsOnDevice;
  ByteCount bytes() const override { return left_bytes(); }
};

TallMatrix<double> widened(const TallMatrix<float>& matrix) {
  return TallMatrix<double>(Eigen::MatrixXd::NullaryExpr(matrix.rows(), matrix.columns(),
                                                         [&](Index e, Index p) { return matrix(e, p); }));
}

/// V of an operator of low rank, for a product in double or float32.
class GlobalRightFactor {
 public:
  using Copy = std::shared_ptr<const RightFactorOnDevice>;

  GlobalRightFactor(const std::shared_ptr<GlDevice>& device, RowStrategy strategy, bool in_double)
      : device_(device), strategy_(strategy), in_double_(in_double) {}

  /// Nothing for operators that are not stored as Scalar or in no way that is known.
  template <typename Scalar>
  Copy of(const LinearOperator& transport) const {
    if (const auto* factors = dynamic_cast<const LowRankOperator<Scalar>*>(&transport))
      return copy(factors->right_factor());
    if (const auto* factors = dynamic_cast<const SparseVOperator<Scalar>*>(&transport))
      return copy(factors->right_factor());
    if (const auto* factors = dynamic_cast<const LowRankKernelOperator<Scalar>*>(&transport))
      return copy(factors->factor());
    if (const auto* factors = dynamic_cast<const TwoSidedOperator<Scalar>*>(&transport))
      return copy(full_right_factor(*factors));
    return nullptr;
  }

 private:
  Copy copy(const Segments& V) const {
    return std::make_shared<SegmentsOnDevice>(device_, V, order_on_device(device_, V), strategy_, in_double_);
  }
  Copy copy(const TallMatrix<double>& V) const {
    return std::make_shared<TallRightFactor>(device_, std::make_shared<TallOnDevice>(device_, V, strategy_));
  }
  Copy copy(const TallMatrix<float>& V) const {
    if (in_double_) return copy(widened(V));
    return std::make_shared<TallRightFactor>(device_, std::make_shared<TallOnDevice>(device_, V, strategy_));
  }

  std::shared_ptr<GlDevice> device_;
  RowStrategy strategy_;
  bool in_double_;
};

Eigen::VectorXd diagonal_before(const LinearOperator& transport) {
  const auto* kernel = dynamic_cast<const KernelOperator*>(&transport);
  return kernel != nullptr ? kernel->root_area() : Eigen::VectorXd::Ones(transport.size());
}

}  // namespace

GlobalFactors global_factors_on_device(const std::shared_ptr<GlDevice>& device, const GlobalOperator& global,
                                       RowStrategy strategy) {
  const LinearOperator& transport = global.transport();
  const bool in_double = std::holds_alternative<FactorMatrix<double>>(global.left_factors().front());
  const GlobalRightFactor right(device, strategy, in_double);
  auto V = right.of<float>(transport);
  if (V == nullptr) V = right.of<double>(transport);
  GlobalFactors factors{{}, diagonal_before(transport)};
  if (V == nullptr) return factors;
  for (const auto& left : global.left_factors()) {
    auto Y = std::visit(
        [&](const auto& matrix) { return std::make_shared<TallOnDevice>(device, matrix, strategy); }, left);
    if (factors.products.empty())
      factors.products.push_back(std::make_unique<FactorsOnDevice>(device, "Y", std::move(Y), V));
    else
      factors.products.push_back(std::make_unique<FactorsWithSharedV>(device, "Y", std::move(Y), V));
  }
  return factors;
}

}  // namespace radiosity

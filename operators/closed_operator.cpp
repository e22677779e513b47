#include "operators/closed_operator.hpp"

#include "factorizations/symmetric_scaling.hpp"
#include "foundation/error.hpp"
#include "kernels/products.hpp"
#include "operators/field_checks.hpp"
#include "operators/kernel_error.hpp"
#include "operators/kernel_operator.hpp"
#include "operators/reflectance.hpp"
#include "operators/rounding_certificate.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace radiosity {

namespace {

Eigen::VectorXd kernel_row_sums(const KernelOperator& kernel) {
  Field sums(kernel.size(), 1);
  kernel.apply_kernel(kernel.root_area(), sums);
  return sums.col(0).cwiseQuotient(kernel.root_area());
}

/// D T~, with one D a channel: matrices of their own for each channel are off differently.
class RowClosedOperator final : public LinearOperator {
 public:
  RowClosedOperator(std::unique_ptr<LinearOperator> approximation, const FormFactors& form_factors)
      : approximation_(std::move(approximation)) {
    const Eigen::MatrixXd& reflectance = form_factors.mesh->reflectance;
    const Eigen::VectorXd target = form_factors.row_sums();
    const Field ones = Field::Ones(size(), channels());
    Field reached(size(), channels());  // rho_i sum_j F~_ij
    approximation_->apply(ones, reached);
    factors_ = ones;
    for (Index i = 0; i < size(); ++i) {
      for (Index c = 0; c < channels(); ++c)
        if (target[i] > 0 && reached(i, c) > 0)
          factors_(i, c) = reflectance(i, c) * target[i] / reached(i, c);
      Index brightest = 0;
      if (reflectance.row(i).maxCoeff(&brightest) > 0 && target[i] > 0 && !(reached(i, brightest) > 0))
        ++empty_rows_;
    }
  }

  Index size() const override { return approximation_->size(); }
  Index channels() const override { return approximation_->channels(); }
  ByteCount bytes() const override {
    ByteCount bytes = approximation_->bytes();
    bytes.parts.emplace_back("closure", sizeof(double) * static_cast<std::size_t>(factors_.size()));
    return bytes;
  }
  std::string describe() const override { return with_keys(approximation_->describe(), "closure=rows"); }
  double product_roundoff() const override { return approximation_->product_roundoff(); }
  std::optional<DeviceUse> device_use() const override { return approximation_->device_use(); }
  std::string remark() const override {
    if (empty_rows_ == 0) return {};
    return fmt::format("{} rows have no positive sum and cannot be closed by scaling", empty_rows_);
  }

 protected:
  void apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const override {
    Field product(X.rows(), X.cols());
    approximation_->apply(X, product);
    add_product(alpha * factors_.array(), product, beta, Y);
  }

 private:
  std::unique_ptr<LinearOperator> approximation_;
  Field factors_;  // d, n x channels
  Index empty_rows_ = 0;
};

/// What closures that stay symmetric share.
class ClosedKernelOperator : public KernelOperator {
 public:
  std::string describe() const final { return with_keys(approximation_->describe(), keys_); }
  double product_roundoff() const final { return approximation_->product_roundoff(); }
  std::optional<DeviceUse> device_use() const final { return approximation_->device_use(); }

 protected:
  ClosedKernelOperator(std::unique_ptr<KernelOperator> approximation, std::string keys,
                       const FormFactors& form_factors)
      : KernelOperator(form_factors), approximation_(std::move(approximation)), keys_(std::move(keys)) {}

  const KernelOperator& approximation() const { return *approximation_; }

 private:
  std::unique_ptr<KernelOperator> approximation_;
  std::string keys_;
};

/// K~ itself, where its operator would be closed if the spec did not say otherwise.
class UnclosedOperator final : public ClosedKernelOperator, public StandsForKernel {
 public:
  UnclosedOperator(std::unique_ptr<KernelOperator> kernel, std::string keys, const FormFactors& form_factors)
      : ClosedKernelOperator(std::move(kernel), std::move(keys), form_factors) {}

  ByteCount bytes() const override { return approximation().bytes(); }
  Certificate certificate() const override { return approximation().certificate(); }
  std::string remark() const override { return approximation().remark(); }
  const KernelOperator& kernel_stood_for() const override { return approximation(); }

 protected:
  void multiply_kernel(const ConstFieldRef& X, FieldRef Y) const override {
    approximation().apply_kernel(X, Y);
  }
};

constexpr double row_sum_rounding = 1e-6;  // of row sums, where products are done in float

/// D K~ D.
class ScaledKernelOperator final : public ClosedKernelOperator {
 public:
  ScaledKernelOperator(std::unique_ptr<KernelOperator> kernel, std::string keys,
                       const FormFactors& form_factors)
      : ClosedKernelOperator(std::move(kernel), std::move(keys), form_factors) {
    const VectorProduct product = [&](const Eigen::VectorXd& x) {
      Field y(size(), 1);
      approximation().apply_kernel(x, y);
      return Eigen::VectorXd(y.col(0));
    };
    scaling_ = scale_symmetric(product, root_area(), form_factors.row_sums(), row_sum_rounding);
  }

  ByteCount bytes() const override {
    ByteCount bytes = approximation().bytes();
    bytes.parts.emplace_back("closure", sizeof(double) * static_cast<std::size_t>(size()));
    return bytes;
  }
  std::string remark() const override { return scaling_.note; }

  /// D T~ D - T = (D T~ D - T~) + (T~ - T), and the first is at most (2 e + e^2) ||T~|| with e = ||D - I||. D
  /// multiplies rho(T~) by ||D||^2 at most, both being symmetric between R^{1/2}.
  Certificate certificate() const override {
    Certificate certificate = approximation().certificate();
    const double change = size() == 0 ? 0 : (scaling_.factors.array() - 1).abs().maxCoeff();
    const double growth = size() == 0 ? 1 : scaling_.factors.array().square().maxCoeff();
    if (certificate.spectral_radius_bound) *certificate.spectral_radius_bound *= growth;
    if (certificate.operator_error)
      *certificate.operator_error += (2 * change + change * change) * (1 + *certificate.operator_error);
    return certificate;
  }

 protected:
  void multiply_kernel(const ConstFieldRef& X, FieldRef Y) const override {
    const Field scaled = scaling_.factors.asDiagonal() * X;
    approximation().apply_kernel(scaled, Y);
    Y = scaling_.factors.asDiagonal() * Y;
  }

 private:
  SymmetricScaling scaling_;
};

/// K~ + X P' + P W' with X = (K - K~) P and W = X - P (P'X).
class BlockClosedOperator final : public ClosedKernelOperator {
 public:
  BlockClosedOperator(std::unique_ptr<KernelOperator> kernel, std::string keys,
                      const FormFactors& form_factors, Rooms rooms)
      : ClosedKernelOperator(std::move(kernel), std::move(keys), form_factors), rooms_(std::move(rooms)) {
    const Eigen::MatrixXd P = rooms_.indicators(root_area());
    scale_ = Eigen::VectorXd::Ones(rooms_.count);
    for (Index i = 0; i < size(); ++i) {
      const int room = rooms_.of_patch[static_cast<std::size_t>(i)];
      if (room >= 0) scale_[room] = P(i, room) / root_area()[i];
    }
    Field approximate(size(), rooms_.count);
    defect_.resize(size(), rooms_.count);
    if (rooms_.count == 0 || size() == 0) return;
    multiply(*form_factors.kernel, P, defect_);
    rounding_ = *approximation_certificate({0, form_factors.row_sums(), kernel_row_sums(approximation())},
                                           2 * product_rounding<float>(size()), reflectance(), root_area())
                     .operator_error;
    approximation().apply_kernel(P, approximate);
    defect_ -= approximate;
    coupling_ = P.transpose() * defect_;
    coupling_ = 0.5 * (coupling_ + coupling_.transpose()).eval();
  }

  ByteCount bytes() const override {
    ByteCount bytes = approximation().bytes();
    const auto n = static_cast<std::size_t>(size()), m = static_cast<std::size_t>(rooms_.count);
    bytes.parts.emplace_back("closure", sizeof(double) * (n * m + m * m + m) + sizeof(int) * n);
    return bytes;
  }

  /// K^ - K = -Q (K - K~) Q is no larger than K - K~ (docs/theory.md, 4), but for the rounding of X, which
  /// enters from either side. Entries may be negative: row sums bound no spectral radius.
  Certificate certificate() const override {
    Certificate certificate = approximation().certificate();
    certificate.spectral_radius_bound.reset();
    if (certificate.operator_error) *certificate.operator_error += rounding_;
    return certificate;
  }

 protected:
  void multiply_kernel(const ConstFieldRef& X, FieldRef Y) const override {
    approximation().apply_kernel(X, Y);
    if (rooms_.count == 0) return;
    for (Index j = 0; j < Y.cols(); ++j) {  // one by one: a column must not depend on how many there are
      const Eigen::VectorXd means = room_sums(X.col(j));                                 // P' x
      const Eigen::VectorXd gains = defect_.transpose() * X.col(j) - coupling_ * means;  // W' x
      Y.col(j).noalias() += defect_ * means;
      for (Index i = 0; i < size(); ++i) {
        const int room = rooms_.of_patch[static_cast<std::size_t>(i)];
        if (room >= 0) Y(i, j) += scale_[room] * root_area()[i] * gains[room];
      }
    }
  }

 private:
  Eigen::VectorXd room_sums(const Eigen::VectorXd& x) const {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(rooms_.count);
    for (Index i = 0; i < size(); ++i) {
      const int room = rooms_.of_patch[static_cast<std::size_t>(i)];
      if (room >= 0) sums[room] += root_area()[i] * x[i];
    }
    return scale_.cwiseProduct(sums);
  }

  double rounding_ = 0;  // of X, relative to ||T||
  Rooms rooms_;
  Eigen::VectorXd scale_;     // P_ir = scale_r A_i^{1/2} on room r
  Eigen::MatrixXd defect_;    // X, n x m
  Eigen::MatrixXd coupling_;  // P' X, m x m
};

Rooms chosen_rooms(const ClosureChoice& choice, const FormFactors& form_factors) {
  if (choice.blocks == "groups") return rooms_of_groups(form_factors);
  Rooms rooms = find_rooms(form_factors);
  if (choice.blocks == "rooms") return rooms;
  return divide_rooms(form_factors, rooms, std::stoi(choice.blocks));
}

std::unique_ptr<KernelOperator> as_kernel(std::unique_ptr<LinearOperator> transport, const std::string& why) {
  auto* kernel = dynamic_cast<KernelOperator*>(transport.get());
  if (kernel == nullptr || !transport->symmetric())
    fail<UsageError>("{} needs a symmetric kernel, which {} is not: use closure=rows or none", why,
                     transport->describe());
  std::unique_ptr<KernelOperator> owned(kernel);
  static_cast<void>(transport.release());
  return owned;
}

void require_true_kernel(const FormFactors& form_factors, const std::string& why) {
  if (!form_factors.symmetric())
    fail<UsageError>("{} needs a symmetric kernel, which form factors by '{}' do not have: use closure=rows",
                     why, form_factors.quality.method);
}

/// The rule of OperatorClosure::automatic.
OperatorClosure choose_closure(const LinearOperator& transport, const FormFactors& form_factors) {
  constexpr double exact_rows = 1e-6;
  const auto* kernel = dynamic_cast<const KernelOperator*>(&transport);
  if (kernel == nullptr || !form_factors.symmetric() || transport.size() == 0) return OperatorClosure::none;
  const Eigen::VectorXd defect = kernel_row_sums(*kernel) - form_factors.row_sums();
  return defect.cwiseAbs().maxCoeff() <= exact_rows ? OperatorClosure::none : OperatorClosure::blocks;
}

void check_blocks(const std::string& blocks, const std::string& spec) {
  if (blocks == "rooms" || blocks == "groups") return;
  int count = 0;
  const auto [end, error] = std::from_chars(blocks.data(), blocks.data() + blocks.size(), count);
  if (error != std::errc() || end != blocks.data() + blocks.size() || count < 1 || count > 4096)
    fail<UsageError>("'{}': blocks={} is neither rooms nor groups nor a number from 1 to 4096", spec, blocks);
}

}  // namespace

ClosureChoice ClosureChoice::take(Spec& spec, const std::string& fallback) {
  ClosureChoice choice;
  const std::string kind = spec.text("closure", fallback);
  if (kind == "rows")
    choice.kind = OperatorClosure::rows;
  else if (kind == "symmetric")
    choice.kind = OperatorClosure::symmetric;
  else if (kind == "blocks")
    choice.kind = OperatorClosure::blocks;
  else if (kind == "automatic")
    choice.kind = OperatorClosure::automatic;
  else if (kind != "none")
    fail<UsageError>("'{}': closure={} is none of none, rows, symmetric, blocks, automatic", spec.text(),
                     kind);
  if (kind != fallback || kind != "none") choice.text = "closure=" + kind;
  if (choice.kind == OperatorClosure::blocks) {
    choice.blocks = spec.text("blocks", "rooms");
    check_blocks(choice.blocks, spec.text());
    if (choice.blocks != "rooms") choice.text += ",blocks=" + choice.blocks;
  }
  return choice;
}

std::unique_ptr<LinearOperator> close_operator(std::unique_ptr<LinearOperator> approximation,
                                               const ClosureChoice& choice, const FormFactors& form_factors) {
  OperatorClosure kind = choice.kind;
  if (approximation->global() && kind != OperatorClosure::none)
    fail<UsageError>("{} restores row sums of T, and {} maps E to B: leave the closure away", choice.text,
                     approximation->describe());
  std::string keys = choice.text;
  if (kind == OperatorClosure::automatic) {
    kind = choose_closure(*approximation, form_factors);
    keys = "closure=blocks";
  }
  if (kind == OperatorClosure::none) {
    if (choice.text != "closure=none" || !approximation->symmetric()) return approximation;
    return std::make_unique<UnclosedOperator>(as_kernel(std::move(approximation), choice.text), choice.text,
                                              form_factors);
  }
  if (kind == OperatorClosure::rows)
    return std::make_unique<RowClosedOperator>(std::move(approximation), form_factors);
  require_true_kernel(form_factors, keys);
  auto kernel = as_kernel(std::move(approximation), keys);
  if (kind == OperatorClosure::symmetric)
    return std::make_unique<ScaledKernelOperator>(std::move(kernel), keys, form_factors);
  return std::make_unique<BlockClosedOperator>(std::move(kernel), keys, form_factors,
                                               chosen_rooms(choice, form_factors));
}

}  // namespace radiosity

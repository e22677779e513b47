#include "operators/global_operator.hpp"

#include "foundation/error.hpp"
#include "foundation/spec.hpp"
#include "operators/capacitance.hpp"
#include "operators/reflectance.hpp"

#include <fmt/format.h>

#include <utility>

namespace radiosity {
namespace {

/// The worst condition for which Y is kept in float32.
constexpr double single_precision_condition = 1e6;

const LowRankFactors* require_factors(const LinearOperator& transport) {
  const auto* factors = dynamic_cast<const LowRankFactors*>(&transport);
  if (transport.device_use())
    fail<UsageError>("global=1 needs the factors of {} on the CPU: copy its global operator to the device",
                     transport.describe());
  if (factors == nullptr)
    fail<UsageError>(
        "global=1 needs an operator of low rank, such as svd:k=64, which {} is not: leave it away",
        transport.describe());
  return factors;
}

void require_decaying_light(const CapacitanceMatrices& capacitances, const LinearOperator& transport) {
  if (capacitances.singular())
    fail(
        "{}: there is no global operator, since I - T is singular (a reflectance of 1 in a closed room): "
        "lower "
        "the reflectance (--max-reflectance)",
        transport.describe());
  // Eigenvalues of T within the unit circle leave det (I - T) = det (I - V' R U) positive.
  for (Index distinct = 0; distinct < capacitances.reflectances().count(); ++distinct)
    if (!capacitances.of_distinct(distinct).has_positive_determinant())
      fail(
          "{}: there is no global operator, since the spectral radius of T is above 1, so that light would "
          "grow "
          "at every bounce: take a higher rank or lower the reflectance (--max-reflectance)",
          transport.describe());
}

}  // namespace

GlobalOperator::GlobalOperator(std::unique_ptr<LinearOperator> transport)
    : transport_(std::move(transport)),
      factors_(require_factors(*transport_)),
      reflectances_(factors_->albedo()) {
  const CapacitanceMatrices capacitances(*factors_);
  require_decaying_light(capacitances, *transport_);
  const double condition = 1 / capacitances.reciprocal_condition();
  const bool single = product_roundoff() > 0x1p-53;
  const bool repaired = single && condition > single_precision_condition;
  if (repaired)
    remark_ =
        fmt::format("the capacitance matrix has a condition of {:.1e}: Y is kept in float64", condition);
  for (Index distinct = 0; distinct < reflectances_.count(); ++distinct) {
    Field left(size(), rank());
    factors_->multiply_left(
        capacitances.of_distinct(distinct).solve(Eigen::MatrixXd::Identity(rank(), rank())), left);
    left = factors_->albedo().col(reflectances_.representative(distinct)).asDiagonal() * left;
    if (single && !repaired)
      Y_.emplace_back(std::in_place_type<FactorMatrix<float>>, left);
    else
      Y_.emplace_back(std::in_place_type<FactorMatrix<double>>, left);
  }
}

ByteCount GlobalOperator::bytes() const {
  std::size_t of_left = 0;
  for (const auto& factor : Y_)
    of_left += std::visit([](const auto& matrix) { return matrix.entry_bytes(); }, factor);
  return {{{"Y", of_left}, {"V", factors_->right_bytes()}}};
}

std::string GlobalOperator::describe() const {
  return with_keys(transport_->describe(), "global=1");
}

void GlobalOperator::apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const {
  Field coefficients(rank(), X.cols());
  factors_->multiply_right_transposed(X, coefficients);
  const Field reflected = reflectances_.multiply_each(
      coefficients, size(), [&](Index distinct, const Field& own, FieldRef images) {
        std::visit([&](const auto& left) { multiply(left, own, images, instructions_); },
                   Y_[static_cast<std::size_t>(distinct)]);
      });
  add_answer(alpha, X, reflected, beta, Y);
}

Eigen::MatrixXd GlobalOperator::term_sizes() const {
  Field right(rank(), size());
  factors_->multiply_right_transposed(Field::Identity(size(), size()), right);
  Eigen::MatrixXd sizes = Eigen::MatrixXd::Zero(size(), size());
  for (const auto& factor : Y_) {
    Field left(size(), rank());
    std::visit(
        [&](const auto& matrix) { multiply(matrix, Field::Identity(rank(), rank()), left, instructions_); },
        factor);
    sizes = sizes.cwiseMax(left.cwiseAbs() * right.cwiseAbs());
  }
  return sizes + Eigen::MatrixXd::Identity(size(), size());
}

}  // namespace radiosity

#include "operators/low_rank_operator.hpp"

#include "operators/kernel_error.hpp"
#include "operators/rounding_certificate.hpp"
#include "operators/storage_choice.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace radiosity {

std::vector<Eigen::MatrixXd> LowRankFactors::multiply_between(const ConstFieldRef& diagonals) const {
  constexpr Index columns_at_most = 64;
  constexpr Index numbers_together = Index{1} << 23;  // 64 MiB
  const Index n = diagonals.rows();
  const Index columns_together =
      std::clamp(numbers_together / std::max<Index>(n, 1), Index{3}, columns_at_most);
  std::vector<Eigen::MatrixXd> products(static_cast<std::size_t>(diagonals.cols()),
                                        Eigen::MatrixXd(rank(), rank()));
  for (Index first = 0; first < rank(); first += columns_together) {
    const Index columns = std::min(columns_together, rank() - first);
    Field unit = Field::Zero(rank(), columns);
    unit.middleRows(first, columns).setIdentity();
    Field left(n, columns);
    multiply_left(unit, left);
    for (Index d = 0; d < diagonals.cols(); ++d) {
      const Field weighted = diagonals.col(d).asDiagonal() * left;
      multiply_right_transposed(weighted, products[static_cast<std::size_t>(d)].middleCols(first, columns));
    }
  }
  return products;
}

template <typename Scalar>
LowRankOperator<Scalar>::LowRankOperator(const FormFactors& form_factors, const Eigen::MatrixXd& U,
                                         const Eigen::MatrixXd& V, std::string spec, std::string remark)
    : MatrixOperator(form_factors), U_(U), V_(V), spec_(std::move(spec)), remark_(std::move(remark)) {}

template <typename Scalar>
ByteCount LowRankOperator<Scalar>::bytes() const {
  return {
      {{"U", U_.entry_bytes()}, {"V", V_.entry_bytes()}, {"diagonals", diagonal_bytes(size(), channels())}}};
}

template <typename Scalar>
void LowRankOperator<Scalar>::multiply_matrix(const ConstFieldRef& X, FieldRef Y) const {
  Field coefficients(rank(), X.cols());
  multiply_transposed(V_, X, coefficients, instructions_);
  multiply(U_, coefficients, Y, instructions_);
}

template <typename Scalar>
void LowRankOperator<Scalar>::multiply_matrix_transposed(const ConstFieldRef& X, FieldRef Y) const {
  Field coefficients(rank(), X.cols());
  multiply_transposed(U_, X, coefficients, instructions_);
  multiply(V_, coefficients, Y, instructions_);
}

namespace {

/// The norm of what is left out is an eigenvalue, which is tight; entries may have any sign, so that row sums
/// bound no spectral radius, but the largest |value| does, times the largest reflectance and the square of
/// `stored_norm`, ||Q||_2 as it is stored.
Certificate low_rank_certificate(const FormFactors& form_factors, const Eigen::VectorXd& values, double error,
                                 double rounding, double stored_norm) {
  if (form_factors.patch_count() == 0) return {};
  const double norm = values.size() == 0 ? 0 : values.cwiseAbs().maxCoeff();
  const Eigen::VectorXd root_area = form_factors.mesh->area.cwiseSqrt();
  Certificate certificate = approximation_certificate(
      {error, form_factors.row_sums(), Eigen::VectorXd::Constant(root_area.size(), norm)}, rounding,
      form_factors.mesh->reflectance, root_area);
  certificate.spectral_radius_bound = form_factors.mesh->reflectance.maxCoeff() * norm * stored_norm *
                                      stored_norm * (1 + 1e-12 * static_cast<double>(root_area.size()));
  return certificate;
}

}  // namespace

template <typename Scalar>
LowRankKernelOperator<Scalar>::LowRankKernelOperator(const FormFactors& form_factors,
                                                     const Eigen::MatrixXd& Q, const Eigen::VectorXd& values,
                                                     std::optional<double> error, std::string spec)
    : KernelOperator(form_factors), Q_(Q), values_(values), spec_(std::move(spec)) {
  // Rounding: each of the two products by n or k terms, and of the stored numbers; |Q| |Q'| may be as large
  // as k.
  const double rounding =
      2 * product_rounding<Scalar>(size()) * static_cast<double>(std::max<Index>(rank(), 1));
  // Rounding each number of k columns of length 1 changes the norm by at most u sqrt(k).
  const double stored_norm =
      1 + (sizeof(Scalar) == 8 ? 0x1p-53 : 0x1p-24) * std::sqrt(static_cast<double>(rank()));
  if (error) certificate_ = low_rank_certificate(form_factors, values, *error, rounding, stored_norm);
}

template <typename Scalar>
ByteCount LowRankKernelOperator<Scalar>::bytes() const {
  return {{{"Q", Q_.entry_bytes()},
           {"values", static_cast<std::size_t>(rank()) * sizeof(double)},
           {"diagonals", diagonal_bytes(size(), channels())}}};
}

template <typename Scalar>
void LowRankKernelOperator<Scalar>::multiply_kernel(const ConstFieldRef& X, FieldRef Y) const {
  Field coefficients(rank(), X.cols());
  multiply_transposed(Q_, X, coefficients, instructions_);
  coefficients = values_.asDiagonal() * coefficients;
  multiply(Q_, coefficients, Y, instructions_);
}

template <typename Scalar>
void LowRankKernelOperator<Scalar>::multiply_left(const ConstFieldRef& C, FieldRef Y) const {
  const Field scaled = values_.asDiagonal() * C;
  multiply(Q_, scaled, Y, instructions_);
  Y = root_area().cwiseInverse().asDiagonal() * Y;
}

template <typename Scalar>
void LowRankKernelOperator<Scalar>::multiply_right_transposed(const ConstFieldRef& X, FieldRef C) const {
  const Field scaled = root_area().asDiagonal() * X;
  multiply_transposed(Q_, scaled, C, instructions_);
}

template class LowRankOperator<double>;
template class LowRankOperator<float>;
template class LowRankKernelOperator<double>;
template class LowRankKernelOperator<float>;

}  // namespace radiosity

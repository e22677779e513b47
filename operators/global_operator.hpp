#pragma once

#include "operators/distinct_reflectances.hpp"
#include "operators/low_rank_operator.hpp"

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace radiosity {

/// G = (I - T)^-1 for an operator T = R U V' of low rank: B = E + Y V' E with
///
///   Y = R U (I - V' R U)^-1, n x k, one a distinct column of R
///
/// (document 004, Eq. 5, whose Y has the other sign): all bounces by 2 n k multiplications a column. V is the
/// operator's own, and Y is stored as its factors are; but where its products are in float32 and a
/// capacitance matrix is worse conditioned than 1e6, Y is kept in float64 (hard-cases.md, W1), and remark()
/// says so. U stays in memory with V; no product reads it and bytes() does not count it.
class GlobalOperator final : public LinearOperator {
 public:
  using LeftFactor = std::variant<FactorMatrix<float>, FactorMatrix<double>>;

  /// Throws UsageError if the operator is not of low rank; Error if I - T is singular, or if light grows at
  /// every bounce (det (I - T) < 0 proves a spectral radius above 1), so that G is not the sum of bounces.
  explicit GlobalOperator(std::unique_ptr<LinearOperator> transport);

  Index size() const override { return transport_->size(); }
  Index channels() const override { return transport_->channels(); }
  bool global() const override { return true; }
  ByteCount bytes() const override;
  std::string describe() const override;
  double product_roundoff() const override { return transport_->product_roundoff(); }
  std::string remark() const override { return remark_; }

  Index rank() const { return factors_->rank(); }
  /// T, whose V this is, and Y, one a distinct reflectance (DistinctReflectances), all in one precision.
  const LinearOperator& transport() const { return *transport_; }
  const Eigen::MatrixXd& reflectance() const { return factors_->albedo(); }
  const std::vector<LeftFactor>& left_factors() const { return Y_; }
  /// I + |Y| |V'|, n x n, the largest over channels: the size of what cancels in the entries of G.
  Eigen::MatrixXd term_sizes() const;

 protected:
  void apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const override;

 private:
  std::unique_ptr<LinearOperator> transport_;
  const LowRankFactors* factors_;  ///< of transport_
  DistinctReflectances reflectances_;
  InstructionSet instructions_ = best_instruction_set();
  std::vector<LeftFactor> Y_;  ///< one a distinct reflectance
  std::string remark_;
};

}  // namespace radiosity

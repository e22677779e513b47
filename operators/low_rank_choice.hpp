#pragma once

#include "factorizations/basis_projection.hpp"
#include "foundation/spec.hpp"
#include "operators/form_factor_products.hpp"
#include "operators/linear_operator.hpp"

#include <memory>
#include <string>
#include <utility>

namespace radiosity {

/// The keys that low-rank operators share: k=64,norm=plain|area,storage=f32|f64.
struct LowRankChoice {
  Index rank = 64;
  FactorizationNorm norm = FactorizationNorm::plain;
  std::string storage;

  static LowRankChoice take(Spec& spec);

  bool in_area_norm() const { return norm == FactorizationNorm::area; }

  /// Weights under which functions of length 1 are so in this norm: A^{1/2}, or 1 in the plain norm; n.
  Eigen::VectorXd root_weight(const PatchMesh& mesh) const;

  /// The keys as a spec has them.
  std::string text() const;

  /// Throws UsageError where the area norm is chosen and there is no symmetric kernel.
  void require_kernel(const FormFactors& form_factors) const;
};

/// Operator<double> or Operator<float>, as `storage` names it.
template <template <typename> class Operator, typename... Arguments>
std::unique_ptr<LinearOperator> make_stored_as(const std::string& storage, Arguments&&... arguments) {
  if (storage == "f64") return std::make_unique<Operator<double>>(std::forward<Arguments>(arguments)...);
  return std::make_unique<Operator<float>>(std::forward<Arguments>(arguments)...);
}

/// The LowRankOperator of a pair that approximates F or, in the area norm, K: then F ~ (A^{-1/2} U) (A^{1/2}
/// V)'. It remarks on it if the pair has fewer columns than were asked for.
std::unique_ptr<LinearOperator> make_low_rank_operator(const LowRankChoice& choice,
                                                       const FormFactors& form_factors, LowRankPair pair,
                                                       std::string spec);

}  // namespace radiosity

#pragma once

#include "factorizations/lapack.hpp"
#include "operators/distinct_reflectances.hpp"
#include "operators/low_rank_operator.hpp"

#include <vector>

namespace radiosity {

/// The capacitance matrices C = I - V' R U of an operator T = R U V' of low rank (document 004, Eqs. 4 and
/// 5), k x k, one a distinct column of R: made by k products with U and V and factored in double.
class CapacitanceMatrices {
 public:
  explicit CapacitanceMatrices(const LowRankFactors& factors);

  const DistinctReflectances& reflectances() const { return reflectances_; }
  const LuFactors& of_distinct(Index distinct) const { return factored_[static_cast<std::size_t>(distinct)]; }
  const LuFactors& of_channel(Index channel) const { return of_distinct(reflectances_.of_channel(channel)); }

  /// The smallest of any of them, as LuFactors estimates it.
  double reciprocal_condition() const;

  /// Whether one of them is not to be told from a singular matrix: a reciprocal condition below k u.
  bool singular() const;

 private:
  Index rank_;
  DistinctReflectances reflectances_;
  std::vector<LuFactors> factored_;
};

}  // namespace radiosity

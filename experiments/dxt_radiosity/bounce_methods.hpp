#pragma once

#include "experiments/dxt_radiosity/light_answers.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace radiosity {

/// A way from E to B = E + T E + ... + T^k E, or on to all bounces.
struct BounceMethod {
  std::string name;
  std::size_t bytes = 0;  ///< of all that it reads
  /// B from E, n x channels, or more columns, lights one after the other.
  std::function<void(const Field& emission, Field& radiosity)> answer;
};

/// F in float32, applied to one channel after another, bounce by bounce: document 000's naive solver. It
/// reads F 3 k times.
BounceMethod naive_method(const FormFactors& form_factors, long bounces);

/// The same, but F is read once a bounce for all channels, as where each texel holds four factors and is
/// fetched once for a colour (document 000's reference 10).
BounceMethod packed_method(const FormFactors& form_factors, long bounces);

/// F^c in float32, one matrix a channel, bounce by bounce (document 000, Eq. 7).
BounceMethod colour_method(const FormFactors& form_factors, long bounces);

/// One product with an operator that maps E to B, as "bounces:k=3" and "dxt:bounces=3" do, or, for one
/// bounce, that stands for T, as "dxt" does: E + T E.
BounceMethod summed_method(const std::string& name, const std::string& spec, const FormFactors& form_factors,
                           const OperatorRegistry& operators);

/// All bounces by the solver for an operator that stands for T, to a relative residual.
BounceMethod solved_method(const std::string& name, const std::string& spec, double tolerance,
                           const FormFactors& form_factors, const OperatorRegistry& operators,
                           const SolverRegistry& solvers);

}  // namespace radiosity

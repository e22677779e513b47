#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <functional>

namespace radiosity {

/// Y = S X for a symmetric n x n matrix S; X and Y are n x c.
using BlockProduct = std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>;

struct EigenpairOptions {
  /// Pairs with (1 - smallest) / (1 - theta) above this are wanted; `smallest` is the smallest Ritz value
  /// met, or `lowest` if that is larger.
  double wanted_ratio = 3;
  double wanted_value = -1;    ///< or, if it is >= 0, simply those with theta above this
  double lowest = -1;          ///< no eigenvalue of S is below this
  double accuracy = 1e-3;      ///< largest ||S v - theta v|| of a wanted pair
  Eigen::Index most = 64;      ///< pairs
  double confidence = 0.9999;  ///< of rest_bound
  std::uint64_t seed = 1;
};

/// Approximate eigenpairs of a symmetric S, and what is known about all others.
struct LeadingEigenpairs {
  Eigen::VectorXd values;   ///< m Ritz values theta, falling
  Eigen::MatrixXd vectors;  ///< n x m, orthonormal: V
  double residual = 0;      ///< eta = ||S V - V diag(theta)||_F
  double rest_bound = 0;    ///< mu: no eigenvalue of Q S Q, Q = I - V V', exceeds it, with `confidence`
  double confidence = 0;    ///< probability over the random start that rest_bound holds
  double smallest = 0;      ///< smallest Ritz value met: an upper bound of the smallest eigenvalue
  int products = 0;         ///< columns multiplied
};

/// Block Lanczos with full orthogonalization, from random starts in the complement of what was found, until a
/// run meets no wanted Ritz value. So eigenvalues of any multiplicity are found, and the last run bounds the
/// rest: Lanczos values are lower bounds of the largest eigenvalue, but after k steps from a uniformly random
/// direction (lambda - ritz) / (lambda - lowest) exceeds e with probability at most 1.648 sqrt(n)
/// exp(-sqrt(e) (2k - 1)) (Kuczynski and Wozniakowski 1992, theorem 4.2, for S - lowest I), and every column
/// of the block is such a start. If the space is exhausted before, the values are exact to rounding.
LeadingEigenpairs leading_eigenpairs(const BlockProduct& S, Eigen::Index n, const EigenpairOptions& options);

struct EigenvalueInterval {
  double low = 0;            ///< with probability >= confidence every eigenvalue lies between low
  double high = 0;           ///< and high
  double smallest_ritz = 0;  ///< some lie here or below
  double largest_ritz = 0;   ///< and some here or above
  double confidence = 0;
  int products = 0;  ///< columns multiplied
};

/// Where the eigenvalues of a symmetric S lie, whatever their signs: the theorem above at both ends of the
/// spectrum, lambda_1 <= ritz_1 + e (ritz_1 - ritz_k) / (1 - 2e) and alike below.
EigenvalueInterval eigenvalue_interval(const BlockProduct& S, Eigen::Index n, double confidence,
                                       std::uint64_t seed);

}  // namespace radiosity

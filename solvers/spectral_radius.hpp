#pragma once

#include "operators/linear_operator.hpp"

#include <optional>
#include <string>

namespace radiosity {

/// Where the spectral radius of an operator lies, from products with positive fields.
struct SpectralRadius {
  double lower = 0;  ///< min_i (T x)_i / x_i: no larger than the radius, 0 where a patch is black
  std::optional<double>
      upper;            ///< max_i (T x)_i / x_i with an allowance for rounding; empty for signed operators
  double estimate = 0;  ///< growth of x in the last product: what power iteration says
  int products = 0;     ///< products spent
  double confidence =
      1;  ///< of `upper`: 1 where it is proved, less where Lanczos values from a random start bound it
};

/// Bounds the spectral radius of a non-negative T over all its channels by Collatz and Wielandt
/// (hard-cases.md, R2): for every x > 0, min_i (T x)_i / x_i <= radius <= max_i (T x)_i / x_i. x = 1 first,
/// then a few lazy power steps x <- T x + x max/10, which keep x positive on black patches and cannot
/// oscillate. The upper bound is enlarged by 2 (n + 2) u, the rounding of a product in double precision. An
/// operator whose product with x > 0 has a negative entry, or of low rank, is signed: no upper bound but its
/// certificate's.
SpectralRadius collatz_wielandt_bounds(const LinearOperator& transport, int max_products = 20);

/// The same, and for a symmetric kernel that is signed, or whose bound would not be below 1, the bound that
/// Lanczos values of R^{1/2} K R^{1/2} give with a confidence of 0.9999
/// (factorizations/leading_eigenpairs.hpp). Other signed operators have none.
SpectralRadius bound_spectral_radius(const LinearOperator& transport, int max_products = 20);

/// Throws Error if the bound does not prove that B <- E + T B converges; `name` is the solver's. Returns the
/// upper bound.
double require_contraction(const std::string& name, const SpectralRadius& radius);

}  // namespace radiosity

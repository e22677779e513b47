#pragma once

#include "compression/colour_compression.hpp"
#include "form_factors/form_factors.hpp"
#include "operators/linear_operator.hpp"

#include <span>

namespace radiosity {

/// The certificate of A = R M~ C^-1 against T = R M C^-1, M~ >= 0, entry by entry; proved. rho(A) <= its
/// largest row sum, and in the area norm, by Schur's test with A^{1/2} on both sides,
///
///   ||A - T||^2 <= max_i sum_j |A - T|_ij  max_j sum_i A_i |A - T|_ij / A_j,
///
/// plus what products in float add; relative to ||T|| from below, by its value for a uniform field.
/// matrices: M, one a channel; reflectance and colours: n x channels.
Certificate colour_certificate(const CompressedColours& compressed, std::span<const ColourMatrix> matrices,
                               const Eigen::MatrixXd& reflectance, const Eigen::MatrixXd& colours,
                               const Eigen::VectorXd& area);

}  // namespace radiosity

#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/monitor.hpp"
#include "operators/linear_operator.hpp"

#include <optional>
#include <utility>

namespace radiosity {

/// ||A - T||_F / ||T||_F with entries in the area norm, A^{1/2} T A^{-1/2}, over all channels: from the
/// entries of F and from products of A with unit fields, a block of columns at a time. 0 where T is 0 and so
/// is A; empty if only T is 0.
std::optional<double> relative_frobenius_error(const LinearOperator& approximation,
                                               const FormFactors& form_factors, Monitor& monitor);

/// Smallest and largest sum of a row of the operator's F over live patches (exposed > 0): from the kernel
/// where there is one, else from T 1 / rho on patches that reflect. Empty if no patch is left.
std::optional<std::pair<double, double>> row_sum_range(const LinearOperator& transport,
                                                       const FormFactors& form_factors);

}  // namespace radiosity

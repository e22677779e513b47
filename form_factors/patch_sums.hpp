#pragma once

#include "form_factors/form_factors.hpp"

#include <Eigen/Core>

#include <span>

namespace radiosity {

/// F_ep = sum of F_ej over the elements j of patch p (document 004, section 3.2): n x k from the assembled F,
/// each entry of which is read once. patch_of_element: n numbers 0 ... k - 1. The same bits for any number of
/// threads. Throws UsageError where the numbers do not fit.
Eigen::MatrixXd patch_sums(const FormFactors& form_factors, std::span<const int> patch_of_element, Index k);

}  // namespace radiosity

#pragma once

#include "form_factors/form_factors.hpp"
#include "operators/linear_operator.hpp"

namespace radiosity {

/// H = F B, n x channels, W/m^2: with the operator's own F where `form_factors` have none. Throws Error where
/// neither has an F.
Field irradiance(const FormFactors& form_factors, const LinearOperator& transport, const Field& radiosity);

}  // namespace radiosity

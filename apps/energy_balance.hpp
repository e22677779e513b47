#pragma once

#include "form_factors/form_factors.hpp"
#include "operators/linear_operator.hpp"

namespace radiosity {

/// Where the light of a solution goes, in W, summed over channels: emitted = absorbed + lost, up to the
/// solver's residual.
struct EnergyBalance {
  double emitted = 0;   ///< sum A E
  double absorbed = 0;  ///< sum A (1 - rho) H, H = F B
  double lost = 0;      ///< sum A (B - H): what leaves the scene or ends on the back of a patch
};

/// H = F B, n x channels, W/m^2: with the operator's own F where `form_factors` have none.
Field irradiance(const FormFactors& form_factors, const LinearOperator& transport, const Field& radiosity);

/// E, B and H are n x channels, W/m^2.
EnergyBalance energy_balance(const PatchMesh& mesh, const Field& emission, const Field& radiosity,
                             const Field& irradiance);

}  // namespace radiosity

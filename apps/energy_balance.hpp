#pragma once

#include "operators/linear_operator.hpp"
#include "scene/patch_mesh.hpp"

namespace radiosity {

/// Where the light of a solution goes, in W, summed over channels: emitted = absorbed + lost, up to the
/// solver's residual.
struct EnergyBalance {
  double emitted = 0;   ///< sum A E
  double absorbed = 0;  ///< sum A (1 - rho) H, H = F B
  double lost = 0;      ///< sum A (B - H): what leaves the scene or ends on the back of a patch
};

/// E, B and H are n x channels, W/m^2.
EnergyBalance energy_balance(const PatchMesh& mesh, const Field& emission, const Field& radiosity,
                             const Field& irradiance);

}  // namespace radiosity

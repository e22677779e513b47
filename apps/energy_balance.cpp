#include "apps/energy_balance.hpp"

namespace radiosity {

EnergyBalance energy_balance(const PatchMesh& mesh, const Field& emission, const Field& radiosity,
                             const Field& irradiance) {
  const Eigen::ArrayXXd absorptance = 1 - mesh.reflectance.array();
  const auto power = [&](const Eigen::ArrayXXd& exitance) {
    return (exitance.colwise() * mesh.area.array()).sum();
  };
  return {power(emission), power(absorptance * irradiance.array()), power(radiosity - irradiance)};
}

}  // namespace radiosity

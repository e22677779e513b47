#include "apps/energy_balance.hpp"

#include "kernels/products.hpp"

namespace radiosity {
namespace {

/// H = F B, n x channels, W/m^2.
Field irradiance(const FormFactors& form_factors, const Field& radiosity) {
  Field result(radiosity.rows(), radiosity.cols());
  if (!form_factors.symmetric()) {
    multiply(*form_factors.unsymmetric, radiosity, result);
    return result;
  }
  const Eigen::ArrayXd root_area = form_factors.mesh->area.array().sqrt();
  const Field scaled = radiosity.array().colwise() * root_area;
  multiply(*form_factors.kernel, scaled, result);
  return result.array().colwise() / root_area;
}

}  // namespace

EnergyBalance energy_balance(const FormFactors& form_factors, const Field& emission, const Field& radiosity) {
  const PatchMesh& mesh = *form_factors.mesh;
  const Field arriving = irradiance(form_factors, radiosity);
  const Eigen::ArrayXXd absorptance = 1 - mesh.reflectance.array();
  const auto power = [&](const Eigen::ArrayXXd& exitance) {
    return (exitance.colwise() * mesh.area.array()).sum();
  };
  return {power(emission), power(absorptance * arriving.array()), power(radiosity - arriving)};
}

}  // namespace radiosity

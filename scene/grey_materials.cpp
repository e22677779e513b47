#include "scene/grey_materials.hpp"

namespace radiosity {

GreyMaterials GreyMaterials::add(SceneBuilder& builder, Spec& spec, double reflectance) {
  const Color rho = Color::Constant(spec.number("reflectance", reflectance, 0, 1));
  return {builder.material({"grey", rho, Color::Zero()}), builder.material({"light", rho, Color::Ones()})};
}

}  // namespace radiosity

#pragma once

#include "foundation/spec.hpp"
#include "scene/scene_builder.hpp"

namespace radiosity {

/// What most built-in scenes are made of: indices of two materials of the same reflectance.
struct GreyMaterials {
  int grey = 0;
  int light = 0;  ///< emits 1 W/m^2

  /// Adds them with the spec's key reflectance=.
  static GreyMaterials add(SceneBuilder& builder, Spec& spec, double reflectance = 0.5);
};

}  // namespace radiosity

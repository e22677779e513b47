#pragma once

#include "form_factors/exact_rooms.hpp"
#include "form_factors/form_factors.hpp"
#include "operators/linear_operator.hpp"

#include <string>

namespace radiosity {

/// Form factors of a built-in scene (traced once, then kept) in one reflectance; 0 keeps the scene's own.
FormFactors traced_scene(const std::string& name, Index patches, double reflectance = 0);

/// A lit problem whose radiosity is known in closed form.
struct KnownSolution {
  FormFactors form_factors;
  Field emission;
  Field radiosity;
};

/// E1: a closed room with uniform E and one reflectance: B = E / (1 - rho).
KnownSolution furnace(Index patches, double reflectance);
/// E2: a sphere with random E: B = E + rho <E> / (1 - rho), <E> its mean over the area.
KnownSolution lit_sphere(Index patches, double reflectance);
/// E2: a spherical bowl of half-angle 60 degrees, partly lit: B = E + rho f <E> / (1 - rho f).
KnownSolution lit_bowl(Index patches, double reflectance);

}  // namespace radiosity

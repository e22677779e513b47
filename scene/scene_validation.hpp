#pragma once

#include "scene/scene.hpp"

namespace radiosity {

/// Relative to the diagonal of a quad: how far its corners may be from one plane.
constexpr double kPlanarityTolerance = 1e-6;

/// Whether four corners are a planar convex quad that may be used as one face. Quads with less than three
/// different corners or without area are not.
bool is_planar_convex_quad(const std::array<Vector3, 4>& corners);

/// Throws Error, naming face, vertex or material, unless indices are in range, vertices finite, quads planar
/// and convex, reflectances in [0, 1] and emissions not negative.
void validate(const Scene& scene);

}  // namespace radiosity

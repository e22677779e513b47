#include "scene/built_in_geometry.hpp"
#include "scene/grey_materials.hpp"
#include "scene/scene_builder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiosity {
namespace {

/// The part of the unit sphere within an angle of a pole at (0, +-1, 0), in rings of equal angle cut into
/// sectors about as wide; corners lie on the sphere.
struct SphericalCap {
  double half_angle = std::numbers::pi;
  int rings = 12;
  double pole = 1;  // y

  int sectors() const {
    const double widest = std::sin(std::min(half_angle, 0.5 * std::numbers::pi));
    return std::max(6, static_cast<int>(std::lround(2 * std::numbers::pi * widest * rings / half_angle)));
  }

  Vector3 point(int ring, int sector) const {
    if (ring == 0) return {0, pole, 0};
    if (ring == rings && half_angle == std::numbers::pi) return {0, -pole, 0};
    const double theta = half_angle * ring / rings;
    const double phi = 2 * std::numbers::pi * (sector % sectors()) / sectors();
    return {std::sin(theta) * std::cos(phi), pole * std::cos(theta), std::sin(theta) * std::sin(phi)};
  }

  /// A facet that looks inwards: a triangle at a pole, else a trapezoid.
  std::vector<Vector3> facet(int ring, int sector) const {
    std::vector<Vector3> corners;
    for (const Vector3& corner :
         {point(ring, sector), point(ring, sector + 1), point(ring + 1, sector + 1), point(ring + 1, sector)})
      if (corners.empty() || (corner != corners.back() && corner != corners.front()))
        corners.push_back(corner);
    if (pole > 0) std::reverse(corners.begin(), corners.end());
    return corners;
  }
};

/// The quarter of the rings around the pole emits.
Scene make_cap(Spec& spec, const SphericalCap& cap, const char* dark_group) {
  SceneBuilder builder(spec.name());
  const GreyMaterials materials = GreyMaterials::add(builder, spec);
  for (int ring = 0; ring < cap.rings; ++ring) {
    const bool lit = ring < std::max(1, cap.rings / 4);
    const int group = builder.group(lit ? "light" : dark_group);
    for (int sector = 0; sector < cap.sectors(); ++sector)
      builder.face(cap.facet(ring, sector), lit ? materials.light : materials.grey, group);
  }
  Scene scene = std::move(builder.scene());
  scene.contacts = Contacts::never;
  scene.conforming = true;
  return scene;
}

}  // namespace

Scene make_sphere_cavity(Spec& spec) {
  SphericalCap cap;
  cap.rings = static_cast<int>(spec.integer("rings", 12, 3, 64));
  Scene scene = make_cap(spec, cap, "wall");
  scene.camera = Camera{{0, -0.3, 0.85}, {0, 0.2, 0}, Vector3::UnitY(), 75.0};
  return scene;
}

Scene make_bowl(Spec& spec) {
  SphericalCap cap;
  cap.half_angle = spec.number("beta", 60, 1, 179) / 180 * std::numbers::pi;
  cap.rings = static_cast<int>(spec.integer("rings", 8, 2, 64));
  cap.pole = -1;
  Scene scene = make_cap(spec, cap, "dark");
  scene.camera = Camera{{0, 2, 2}, {0, -0.6, 0}, Vector3::UnitY(), 39.3077};
  return scene;
}

}  // namespace radiosity

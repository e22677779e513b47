#pragma once

#include "scene/scene.hpp"

namespace radiosity {

enum class FrameLightKind { point, spot };

/// A light that may be elsewhere in every frame. It radiates evenly, or into a cone about the way to its
/// target: in full within spot_full_part of the half angle, and smoothly less up to it.
struct FrameLight {
  FrameLightKind kind = FrameLightKind::point;
  Vector3 position = Vector3::Zero();
  Vector3 target = Vector3::Zero();      ///< of spots; not the position
  Color intensity = Color::Constant(1);  ///< W/sr, of spots on their axis
  double half_angle = 45;                ///< of spots, degrees, in (0, 80]
};

/// Of the half angle of a spot.
constexpr double spot_full_part = 0.8;

/// That of an even radiator of 1 W, W/sr.
constexpr double intensity_of_a_watt = 0.07957747154594767;  // 1 / (4 pi)

/// What arrives of a light at a point of a surface with this unit normal, if nothing is between, W/m^2.
Color unshadowed_irradiance(const FrameLight& light, const Vector3& point, const Vector3& normal);

/// The cosine from which on a spot shines in full, and that where it ends; the smoothstep between them.
struct SpotCone {
  double full;
  double end;
  explicit SpotCone(double half_angle);
  double part(double cosine) const;
};

}  // namespace radiosity

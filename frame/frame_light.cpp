#include "frame/frame_light.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiosity {

SpotCone::SpotCone(double half_angle)
    : full(std::cos(spot_full_part * half_angle * std::numbers::pi / 180)),
      end(std::cos(half_angle * std::numbers::pi / 180)) {}

double SpotCone::part(double cosine) const {
  const double t = std::clamp((cosine - end) / (full - end), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

Color unshadowed_irradiance(const FrameLight& light, const Vector3& point, const Vector3& normal) {
  const Vector3 way = light.position - point;
  const double distance = way.norm();
  const double cosine = way.dot(normal) / distance;
  if (!(cosine > 0)) return Color::Zero();
  double part = 1;
  if (light.kind == FrameLightKind::spot)
    part = SpotCone(light.half_angle).part(-way.dot((light.target - light.position).normalized()) / distance);
  return part * cosine / (distance * distance) * light.intensity;
}

}  // namespace radiosity

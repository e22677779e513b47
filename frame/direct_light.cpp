#include "frame/direct_light.hpp"

namespace radiosity {

bool DirectLight::visible(const PatchHit& at, const Vector3& light) const {
  const Vector3 way = light - at.point;
  const double distance = way.norm();
  const PatchHit hit = rays_.from_patch(at.patch, at.point, way / distance);
  return hit.missed() || (hit.point - at.point).norm() >= distance;
}

Color DirectLight::irradiance(const PatchHit& at) const {
  Color sum = Color::Zero();
  for (const FrameLight& light : lights_) {
    const Color received = unshadowed_irradiance(light, at.point, mesh_.normal.col(at.patch));
    if ((received > 0).any() && visible(at, light.position)) sum += received;
  }
  return sum;
}

}  // namespace radiosity

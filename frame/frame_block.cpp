#include "frame/frame_block.hpp"

#include "foundation/error.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiosity {
namespace {

FrameBlock::Four four(const Vector3& v, double fourth = 0) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()),
          static_cast<float>(fourth)};
}

glm::dvec3 glm_vector(const Vector3& v) {
  return {v.x(), v.y(), v.z()};
}

/// One texel more than a quarter of the sphere on each side, so that neighbours of a texel are in its face.
FrameBlock::Face cube_face(int layer, int size) {
  Vector3 forward = Vector3::Zero();
  Vector3 right = Vector3::Zero();
  Vector3 up = Vector3::Zero();
  const int axis = layer / 2;
  forward[axis] = layer % 2 == 0 ? 1 : -1;
  right[(axis + 1) % 3] = 1;
  up[(axis + 2) % 3] = 1;
  return {four(right), four(up), four(forward, size / (size - 2.0))};
}

FrameBlock::Face spot_face(const FrameLight& light) {
  const Vector3 forward = (light.target - light.position).normalized();
  const Vector3 right = forward.unitOrthogonal();
  return {four(right), four(forward.cross(right)),
          four(forward, std::tan(light.half_angle * std::numbers::pi / 180))};
}

void check(const FrameLight& light) {
  if (light.kind != FrameLightKind::spot) return;
  if (light.position == light.target)
    fail<UsageError>("a spot light is at ({}, {}, {}), which is its target too: it needs a direction",
                     light.position.x(), light.position.y(), light.position.z());
  if (!(light.half_angle > 0 && light.half_angle <= 80))
    fail<UsageError>("a spot light has a half angle of {} degrees; it must be in (0, 80]", light.half_angle);
}

}  // namespace

void set_lights(FrameBlock& block, const std::vector<FrameLight>& lights, const Vector3& origin,
                const ShadowMapping& mapping) {
  if (lights.size() > most_frame_lights)
    fail<UsageError>("{} lights are too many for a frame; at most {} are possible", lights.size(),
                     most_frame_lights);
  int layer = 0;
  for (std::size_t k = 0; k < lights.size(); ++k) {
    const FrameLight& light = lights[k];
    check(light);
    const bool spot = light.kind == FrameLightKind::spot;
    const SpotCone cone(light.half_angle);
    const Vector3 axis = spot ? (light.target - light.position).normalized() : Vector3::Zero();
    FrameBlock::LightOfBlock& into = block.lights[k];
    into.position = four(light.position - origin);
    into.intensity = four(light.intensity.matrix(), spot ? 1 : 0);
    into.axis = four(axis, cone.end);
    into.map = {static_cast<float>(cone.full), static_cast<float>(layer), 0, 0};
    for (int face = 0; face < layers_of(light.kind); ++face)
      block.faces[static_cast<std::size_t>(layer++)] =
          spot ? spot_face(light) : cube_face(face, mapping.size);
  }
  block.scalars[1] = static_cast<float>(mapping.nearest);
  block.scalars[2] = static_cast<float>(lights.size());
  block.scalars[3] = static_cast<float>(mapping.size);
}

void set_camera(FrameBlock& block, const Camera& camera, double aspect, const Vector3& origin,
                double radius) {
  const Vector3 forward = camera.target - camera.position;
  if (!(forward.cross(camera.up).norm() > 1e-9 * forward.norm() * camera.up.norm()))
    fail("the camera has no direction: its position, target and up vector must span a plane");
  const double middle = (origin - camera.position).dot(forward.normalized());
  const double far = std::max(middle + radius, 1e-3 * radius);
  const double near = std::max(middle - radius, 1e-3 * far);
  const glm::dmat4 to_camera = glm::lookAt(glm_vector(camera.position - origin),
                                           glm_vector(camera.target - origin), glm_vector(camera.up));
  const glm::dmat4 to_clip = glm::perspective(glm::radians(camera.vertical_field_of_view), aspect, near, far);
  const glm::mat4 view_projection(to_clip * to_camera);
  std::copy_n(glm::value_ptr(view_projection), block.view_projection.size(), block.view_projection.begin());
}

}  // namespace radiosity

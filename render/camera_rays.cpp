#include "render/camera_rays.hpp"

#include "foundation/error.hpp"
#include "render/bounding_box.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>

#include <cmath>
#include <numbers>

namespace radiosity {
namespace {

glm::dvec3 to_glm(const Vector3& v) {
  return {v.x(), v.y(), v.z()};
}
Vector3 from_glm(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

Camera default_camera(const PatchMesh& mesh) {
  Camera camera;
  if (mesh.patch_count() == 0) return camera;
  const Eigen::AlignedBox3d box = bounding_box(mesh);
  const Vector3 size = box.sizes();
  const bool inwards = mesh.topology.volume < 0;  // fronts face the inside: a room
  const Vector3 level = size.x() > size.z() * (1 + 1e-9) ? Vector3(-1, 0, 0) : Vector3(0, 0, -1);
  const Vector3 aside = level.cross(Vector3::UnitY());
  const Vector3 towards = inwards ? level : (level - 0.35 * Vector3::UnitY() + 0.5 * aside).normalized();

  camera.target = box.center();
  camera.up = Vector3::UnitY();
  const double half_angle = 0.5 * camera.vertical_field_of_view * std::numbers::pi / 180;
  // A room is framed by its near wall, anything else by its bounding sphere.
  const double near_wall = std::max(size.y(), size.dot(aside.cwiseAbs()));
  const double distance = inwards ? 0.5 * size.dot(level.cwiseAbs()) + 0.52 * near_wall / std::tan(half_angle)
                                  : 0.5 * size.norm() / std::sin(half_angle);
  camera.position = camera.target - distance * towards;
  return camera;
}

CameraRays::CameraRays(const Camera& camera, int width, int height) : origin_(camera.position) {
  const Vector3 forward = camera.target - camera.position;
  if (!(forward.cross(camera.up).norm() > 1e-9 * forward.norm() * camera.up.norm()))
    fail("the scene's camera has no direction: its position, target and up vector must span a plane");
  const glm::dmat4 to_camera = glm::lookAt(to_glm(camera.position), to_glm(camera.target), to_glm(camera.up));
  const glm::dmat4 to_clip = glm::perspective(glm::radians(camera.vertical_field_of_view),
                                              static_cast<double>(width) / height, 0.1, 10.0);
  // Directions do not feel the camera's position: undo the rotation and the projection only.
  const glm::dmat4 from_clip = glm::inverse(to_clip * glm::dmat4(glm::dmat3(to_camera)));
  const auto on_far_plane = [&](double x, double y) {
    const glm::dvec4 point = from_clip * glm::dvec4(x, y, 1, 1);
    return from_glm(glm::dvec3(point) / point.w);
  };
  corner_ = on_far_plane(-1, 1);
  right_ = (on_far_plane(1, 1) - corner_) / width;
  down_ = (on_far_plane(-1, -1) - corner_) / height;
}

Vector3 CameraRays::direction(double x, double y) const {
  return (corner_ + x * right_ + y * down_).normalized();
}

}  // namespace radiosity

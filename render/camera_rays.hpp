#pragma once

#include "scene/patch_mesh.hpp"

namespace radiosity {

/// A camera from which all of the mesh can be seen: level, outside the bounding box, y up. It looks along the
/// horizontal axis that the box is longest in, or along -z where x and z are equal; for solids seen from
/// outside it stands a little above and to one side.
Camera default_camera(const PatchMesh& mesh);

/// Rays through the pixels of a width x height picture.
class CameraRays {
 public:
  /// Throws Error for a camera without a direction: position at its target, or looking along its up vector.
  CameraRays(const Camera& camera, int width, int height);

  const Vector3& origin() const { return origin_; }

  /// Unit direction through (x, y) in pixels from the top left corner of the picture, 0 <= x <= width.
  Vector3 direction(double x, double y) const;

 private:
  Vector3 origin_;
  Vector3 corner_;  // from the origin to the top left corner of the picture
  Vector3 right_;   // by one pixel
  Vector3 down_;
};

}  // namespace radiosity

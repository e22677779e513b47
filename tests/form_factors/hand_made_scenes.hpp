#pragma once

#include "form_factors/form_factors.hpp"
#include "scene/patch_mesh.hpp"
#include "scene/scene_builder.hpp"

#include <memory>
#include <string>

namespace radiosity::testing {

inline const Vector3 kX = Vector3::UnitX(), kY = Vector3::UnitY(), kZ = Vector3::UnitZ();

/// Scenes put together face by face, each face a group of its own.
class HandMadeScene {
 public:
  HandMadeScene() : builder_("hand-made") { builder_.material({}); }

  /// A parallelogram with its front towards u x v.
  HandMadeScene& rectangle(const Vector3& corner, const Vector3& u, const Vector3& v) {
    return polygon({corner, corner + u, corner + u + v, corner + v});
  }

  HandMadeScene& polygon(const std::vector<Vector3>& corners) {
    builder_.face(corners, 0, builder_.group("face" + std::to_string(builder_.scene().faces.size())));
    return *this;
  }

  /// A box seen from inside (inward) or outside, with corner o and edges x, y, z (right-handed).
  HandMadeScene& box(const Vector3& o, const Vector3& x, const Vector3& y, const Vector3& z, bool inward) {
    const auto add = [&](const Vector3& p, const Vector3& u, const Vector3& v) {
      inward ? rectangle(p, u, v) : rectangle(p, v, u);
    };
    add(o, x, y), add(o + z, y, x), add(o, z, x), add(o + y, x, z), add(o, y, z), add(o + x, z, y);
    return *this;
  }

  Scene& scene() { return builder_.scene(); }

  std::shared_ptr<const PatchMesh> mesh(const Subdivision& subdivision = {}) {
    return std::make_shared<const PatchMesh>(make_patches(builder_.scene(), subdivision));
  }

 private:
  SceneBuilder builder_;
};

inline FormFactors compute(const std::shared_ptr<const PatchMesh>& mesh,
                           const FormFactorOptions& options = {}) {
  SilentMonitor monitor;
  return compute_form_factors(mesh, options, monitor);
}

inline FormFactorOptions raw(double tolerance = 1e-4) {
  FormFactorOptions options;
  options.tolerance = tolerance;
  options.closure = Closure::none;
  return options;
}

}  // namespace radiosity::testing

#pragma once

#include "form_factors/form_factors.hpp"
#include "frame/frame_path.hpp"
#include "frame/frame_renderer.hpp"
#include "gpu/gl_operators.hpp"
#include "scene/built_in.hpp"
#include "tests/gpu/device_test.hpp"

#include <memory>
#include <string>
#include <vector>

namespace radiosity {

/// Small frames of the Cornell box without its lamp.
class FrameTest : public DeviceTest {
 protected:
  static std::shared_ptr<const PatchMesh> box(Index patches) {
    PatchMesh mesh = make_patches(built_in_scene("cornell-box"), {.patches = patches});
    mesh.emission.setZero();
    return std::make_shared<const PatchMesh>(std::move(mesh));
  }

  /// Quick rather than exact, but without the bias of a single ray.
  static FormFactors form_factors_of(const std::shared_ptr<const PatchMesh>& mesh) {
    FormFactorOptions options;
    options.tolerance = 3e-3;
    SilentMonitor monitor;
    return compute_form_factors(mesh, options, monitor);
  }

  static std::unique_ptr<LinearOperator> on_device(const std::string& spec, const FormFactors& form_factors) {
    return gl_operators(device(), cpu_operators()).make(spec, form_factors);
  }

  /// The light of frame k of so many on an orbit, of 1 W.
  static std::vector<FrameLight> light_at(const PatchMesh& mesh, int k, int frames,
                                          FrameLightKind kind = FrameLightKind::point) {
    const Vector3 place = orbit_path(mesh, frames)[static_cast<std::size_t>(k)].light;
    const Vector3 below(0.3, 0, 0.3);
    return {{kind, place, below, Color::Constant(intensity_of_a_watt), 50}};
  }
};

}  // namespace radiosity

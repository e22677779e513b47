#pragma once

#include "frame/frame_block.hpp"
#include "frame/frame_scene.hpp"
#include "gpu/gl_device.hpp"
#include "operators/linear_operator.hpp"
#include "render/picture.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace radiosity {

/// The stages of a frame in their order (document 000, section 3.6), between what goes to the device and what
/// comes back.
constexpr std::array<const char*, 7> frame_stages = {"upload",   "shadow maps", "emission", "transport",
                                                     "transfer", "rendering",   "read-back"};

/// How patches get the light that arrives straight from lights.
enum class Injection {
  points,  ///< from points on them and the shadow maps (document 000; PatchEmission)
  cube     ///< from a picture of them around each light (document 001; PatchInjection)
};

struct FrameOptions {
  int width = 1280;  ///< pixels
  int height = 720;
  int shadow_size = 1024;  ///< texels of a side of each shadow map
  int products = 8;        ///< with an operator that is not global: bounces after the first reflection
  Injection injection = Injection::points;
};

/// A frame that is done.
struct FinishedFrame {
  std::vector<std::uint8_t> bytes;    ///< tone mapped (render/tone_mapping.hpp): 3 x width x height
  std::vector<double> stage_seconds;  ///< of frame_stages
};

/// Draws a scene in the light of moving lights, all on the device: shadow maps, the emission of patches,
/// their transport by any operator there, the light of vertices, the picture with direct light and shadows in
/// every pixel. Frames allocate nothing and wait for nothing: each is collected while the next is drawn.
///
///   renderer.draw(lights_of(0), camera);
///   for (int i = 1; i < count; ++i) {
///     renderer.draw(lights_of(i), camera);
///     use(renderer.collect());  // frame i - 1
///   }
///   use(renderer.collect());
///
/// Pixels take light at their middle: there is one sample in each. May be called on any thread.
class FrameRenderer {
 public:
  /// `transport` is an operator on the device for the patches that the scene is solved on; it outlives this.
  /// `lights`: of every frame, in their order. Throws what its parts throw, UsageError for options out of
  /// range and for an operator of another number of patches.
  FrameRenderer(std::shared_ptr<GlDevice> device, const FrameScene& scene, const LinearOperator& transport,
                std::vector<FrameLightKind> lights, const FrameOptions& options);
  ~FrameRenderer();

  /// What radiance is multiplied with before it is clamped and encoded; 1 at first.
  void set_exposure(double exposure) { exposure_ = exposure; }

  /// Throws UsageError for other lights than said before and where two frames wait to be collected, Error for
  /// a camera without a direction.
  void draw(const std::vector<FrameLight>& lights, const Camera& camera);
  /// The oldest frame that was drawn and not collected; UsageError where there is none. Valid until the next.
  const FinishedFrame& collect();

  /// The frame's radiance as it is, W/(m^2 sr). Waits for the device; for exposures and comparisons.
  Picture radiance(const std::vector<FrameLight>& lights, const Camera& camera);
  /// Emission and irradiance of the patches in the frame drawn last, n x 3, W/m^2. Waits for the device.
  Eigen::MatrixXd emission() const;
  Eigen::MatrixXd irradiance() const;

 private:
  static constexpr int frames_at_once = 2;
  struct Parts;  ///< what is made with the context current

  void upload(const std::vector<FrameLight>& lights, const Camera& camera, double exposure);

  std::shared_ptr<GlDevice> device_;
  FrameOptions options_;
  std::vector<FrameLightKind> kinds_;
  Vector3 origin_;  ///< of positions on the device, scene units
  double radius_;   ///< everything is within this of it
  double exposure_ = 1;
  FrameBlock block_{};
  std::unique_ptr<Parts> parts_;
  FinishedFrame finished_;
  std::int64_t drawn_ = 0;
  std::int64_t collected_ = 0;
};

}  // namespace radiosity

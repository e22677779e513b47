#include "frame/frame_renderer.hpp"

#include "foundation/error.hpp"
#include "frame/frame_target.hpp"
#include "frame/patch_emission.hpp"
#include "frame/patch_injection.hpp"
#include "frame/pixel_reads.hpp"
#include "frame/shadow_maps.hpp"
#include "frame/shown_surface.hpp"
#include "gpu/resident_transport.hpp"
#include "gpu/stage_timers.hpp"
#include "render/bounding_box.hpp"

#include <algorithm>
#include <epoxy/gl.h>
#include <optional>
#include <utility>

namespace radiosity {
namespace {

constexpr unsigned block_binding = 0;
/// Of the diagonal of the scene: what is nearer to a light throws no shadow. Depth is stored as 1 - nearest /
/// depth, so that a smaller part would cost precision far away.
constexpr double nearest_part = 2e-3;

/// What is drawn and what blocks light.
Eigen::AlignedBox3d box_of(const PatchMesh& shown) {
  Eigen::AlignedBox3d box = bounding_box(shown);
  for (const Vector3& vertex : shown.scene->vertices) box.extend(vertex);
  return box;
}

Eigen::Matrix3Xf blockers(const PatchMesh& shown, const Vector3& origin) {
  return (blocking_triangles(*shown.scene).colwise() - origin).cast<float>();
}

void check(const FrameScene& scene, const LinearOperator& transport) {
  if (scene.shown->patch_count() == 0) fail<UsageError>("there is nothing to draw: the scene has no patch");
  if (scene.points.reflectance.rows() != transport.size())
    fail<UsageError>("an operator of {} patches cannot light a scene of {}", transport.size(),
                     scene.points.reflectance.rows());
}

}  // namespace

struct FrameRenderer::Parts {
  Parts(const std::shared_ptr<GlDevice>& device, const FrameScene& scene, const LinearOperator& transport,
        const std::vector<FrameLightKind>& lights, const FrameOptions& options, const Vector3& origin)
      : block(device->context(), sizeof(FrameBlock)),
        shadows(device->context(), blockers(*scene.shown, origin), lights, options.shadow_size),
        resident(device, transport, options.products),
        surface(device, scene.mesh, *scene.shown, origin),
        target(device->context(), options.width, options.height, FrameTarget::Numbers::srgb_bytes),
        reads(device->context(), options.width, options.height, frames_at_once),
        timers(device->context(), static_cast<int>(frame_stages.size()), frames_at_once) {
    if (options.injection == Injection::cube)
      injection.emplace(device, *scene.solved, lights, origin);
    else
      patch_emission.emplace(device, scene.points, origin);
  }

  /// Everything from shadow maps to the picture; calls ended(k) after stage k.
  template <typename StageEnded>
  void run(const FrameTarget& into, const StageEnded& ended) const {
    block.bind_uniform(block_binding);
    shadows.render();
    ended(1);
    shadows.bind();
    if (injection)
      injection->compute(resident);
    else
      patch_emission->compute(resident);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    ended(2);
    resident.run();
    ended(3);
    surface.gather(resident);
    glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
    ended(4);
    into.begin();
    surface.draw();
    ended(5);
  }

  GlBuffer block;
  ShadowMaps shadows;
  std::optional<PatchEmission> patch_emission;  ///< or else:
  std::optional<PatchInjection> injection;
  ResidentTransport resident;
  ShownSurface surface;
  FrameTarget target;
  PixelReads reads;
  StageTimers timers;
};

FrameRenderer::FrameRenderer(std::shared_ptr<GlDevice> device, const FrameScene& scene,
                             const LinearOperator& transport, std::vector<FrameLightKind> lights,
                             const FrameOptions& options)
    : device_(std::move(device)), options_(options), kinds_(std::move(lights)) {
  check(scene, transport);
  const Eigen::AlignedBox3d box = box_of(*scene.shown);
  origin_ = box.center();
  radius_ = 0.5 * box.diagonal().norm();
  const CurrentContext current(*device_->context());
  parts_ = std::make_unique<Parts>(device_, scene, transport, kinds_, options_, origin_);
}

FrameRenderer::~FrameRenderer() = default;

void FrameRenderer::upload(const std::vector<FrameLight>& lights, const Camera& camera, double exposure) {
  if (!std::equal(lights.begin(), lights.end(), kinds_.begin(), kinds_.end(),
                  [](const FrameLight& light, FrameLightKind kind) { return light.kind == kind; }))
    fail<UsageError>("a frame has other lights than were announced: as many, of the same kinds, must come");
  set_lights(block_, lights, origin_, {options_.shadow_size, nearest_part * 2 * radius_});
  set_camera(block_, camera, static_cast<double>(options_.width) / options_.height, origin_, radius_);
  block_.scalars[0] = static_cast<float>(exposure);
  parts_->block.write(0, sizeof block_, &block_);
}

void FrameRenderer::draw(const std::vector<FrameLight>& lights, const Camera& camera) {
  if (drawn_ - collected_ >= frames_at_once)
    fail<UsageError>("{} frames wait to be collected: no further one can be drawn", frames_at_once);
  const CurrentContext current(*device_->context());
  const int slot = static_cast<int>(drawn_ % frames_at_once);
  StageTimers& timers = parts_->timers;
  timers.begin(slot);
  upload(lights, camera, exposure_);
  timers.end_stage(slot, 0);
  parts_->run(parts_->target, [&](int stage) { timers.end_stage(slot, stage); });
  parts_->reads.start(slot);
  timers.end_stage(slot, static_cast<int>(frame_stages.size()) - 1);
  parts_->reads.fence(slot);
  device_->context()->check("a frame");
  ++drawn_;
}

const FinishedFrame& FrameRenderer::collect() {
  if (collected_ == drawn_) fail<UsageError>("no frame waits to be collected");
  const CurrentContext current(*device_->context());
  const int slot = static_cast<int>(collected_ % frames_at_once);
  parts_->reads.finish(slot, finished_.bytes);
  finished_.stage_seconds = parts_->timers.seconds(slot);
  ++collected_;
  return finished_;
}

Picture FrameRenderer::radiance(const std::vector<FrameLight>& lights, const Camera& camera) {
  const CurrentContext current(*device_->context());
  const FrameTarget floats(device_->context(), options_.width, options_.height, FrameTarget::Numbers::floats);
  upload(lights, camera, 1);
  parts_->run(floats, [](int) {});
  const auto width = static_cast<std::size_t>(options_.width);
  const auto height = static_cast<std::size_t>(options_.height);
  std::vector<float> rows(3 * width * height);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, options_.width, options_.height, GL_RGB, GL_FLOAT, rows.data());
  device_->context()->check("the radiance of a frame");
  Picture picture{options_.width, options_.height, std::vector<float>(rows.size())};
  for (std::size_t y = 0; y < height; ++y)  // OpenGL's begin below
    std::copy_n(rows.data() + 3 * width * (height - 1 - y), 3 * width, picture.pixels.data() + 3 * width * y);
  return picture;
}

Eigen::MatrixXd FrameRenderer::emission() const {
  const CurrentContext current(*device_->context());
  return parts_->resident.emission().read();
}

Eigen::MatrixXd FrameRenderer::irradiance() const {
  const CurrentContext current(*device_->context());
  return parts_->resident.irradiance().read();
}

}  // namespace radiosity

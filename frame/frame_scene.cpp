#include "frame/frame_scene.hpp"

#include <utility>

namespace radiosity {

FrameScene frame_scene(const std::shared_ptr<const PatchMesh>& mesh, int strata) {
  FrameScene scene{mesh, mesh, {}, {}};
  scene.mesh = frame_mesh(*scene.shown);
  scene.points = emission_points(*scene.shown, strata);
  return scene;
}

FrameScene frame_scene(const SimplifiedScene& simplified, std::shared_ptr<const PatchMesh> original,
                       int strata) {
  FrameScene scene{std::move(original), simplified.mesh, {}, {}};
  scene.mesh = frame_mesh(simplified, *scene.shown);
  scene.points = emission_points(simplified, *scene.shown, strata);
  return scene;
}

}  // namespace radiosity

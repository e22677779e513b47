#pragma once

#include "frame/emission_points.hpp"
#include "frame/frame_mesh.hpp"

#include <memory>

namespace radiosity {

/// What frames show and what they are solved on.
struct FrameScene {
  std::shared_ptr<const PatchMesh> shown;
  std::shared_ptr<const PatchMesh> solved;
  FrameMesh mesh;         ///< of `shown`
  EmissionPoints points;  ///< of the patches that are solved on
};

/// Points are a grid of strata x strata on each patch. A mesh that is solved on itself:
FrameScene frame_scene(const std::shared_ptr<const PatchMesh>& mesh, int strata);
/// One that is solved on few patches in its place, `original` being the mesh that was simplified.
FrameScene frame_scene(const SimplifiedScene& simplified, std::shared_ptr<const PatchMesh> original,
                       int strata);

}  // namespace radiosity

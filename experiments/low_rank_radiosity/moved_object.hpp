#pragma once

#include "experiments/report.hpp"
#include "foundation/monitor.hpp"
#include "operators/linear_operator.hpp"
#include "scene/scene.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace radiosity {

struct PatchMesh;

/// What document 004 leaves to future work: dynamic geometry. A box moves through a closed room, step by
/// step. Elements stay in their patches, so V stays; U changes where the box is one end of a pair or may
/// stand between its ends, and Woodbury's k x k matrix takes the change up, exactly.
struct MovedObjectOptions {
  Index patches = 2400;        ///< n
  Index coarse_patches = 300;  ///< k
  int steps = 4;               ///< from one side of the room to the other
  double tolerance = 1e-3;     ///< of each F_ep
  std::uint64_t seed = 1;
};

/// One place of the box.
struct MovedObjectStep {
  double place = 0;              ///< of the box's middle, m
  double changed = 0;            ///< fraction of the n k form factors that may have changed
  double update_seconds = 0;     ///< to compute these
  double rebuild_seconds = 0;    ///< to compute all
  double fold_seconds = 0;       ///< to make and factor the k x k matrix
  double frame_seconds = 0;      ///< B from E
  double dense_seconds = 0;      ///< to compute F
  double factor_difference = 0;  ///< ||U_updated - U_rebuilt||_F / ||U_rebuilt||_F
  /// Errors in B against the dense solution, relative in the area norm.
  double stale_error = 0;  ///< U as it was at the start
  double own_error = 0;    ///< with new factors of the box itself, but shadows where they were
  double updated_error = 0;
  double rebuilt_error = 0;
};

struct MovedObject {
  std::shared_ptr<const PatchMesh> mesh;  ///< at the last place
  Index coarse_patches = 0;
  std::vector<MovedObjectStep> steps;
  std::vector<std::shared_ptr<const PatchMesh>> meshes;  ///< at each place
  std::vector<Field> radiosity;                          ///< updated
};

/// A closed room of 5 m with a lamp in the ceiling and a box of 0.75 m that hovers with its middle at `place`
/// from the left wall.
Scene room_with_hovering_box(double place);

/// Throws UsageError where the faces are more than coarse_patches or there is no step.
MovedObject measure_moved_object(const MovedObjectOptions& options, Monitor& monitor);

ReportSection moved_object_section(const MovedObject& object, const std::filesystem::path& strip,
                                   const std::string& command);

/// Measures, writes low_rank_motion.json and low_rank_motion.png into `folder`, returns the section.
ReportSection moved_object(const std::filesystem::path& folder, const std::string& command,
                           const MovedObjectOptions& options, Monitor& monitor);

}  // namespace radiosity

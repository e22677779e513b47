#include "experiments/json_objects.hpp"
#include "experiments/low_rank_radiosity/moved_object.hpp"
#include "experiments/low_rank_radiosity/patch_drawing.hpp"
#include "foundation/output_file.hpp"
#include "scene/patch_mesh.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <vector>

namespace radiosity {
namespace {

namespace fs = std::filesystem;

ReportTable step_table(const MovedObject& object, const std::string& command) {
  ReportTable table;
  table.caption = fmt::format(
      "A box moves through a room of {} × {}. Error in B against the dense solution: U as it was at the "
      "start "
      "(stale), with new factors of the box itself but the old shadows (box), with all that may have changed "
      "(updated), computed anew (rebuilt). Seconds: for the factors that changed, for all, for the k × k "
      "matrices, for B from E, for F of the dense solution.",
      object.mesh->patch_count(), object.coarse_patches);
  table.command = command;
  table.columns = {"box at, m",     "changed, %",    "stale",       "box",     "updated", "rebuilt",
                   "updated in, s", "rebuilt in, s", "k × k in, s", "B in, s", "F in, s"};
  for (const MovedObjectStep& step : object.steps)
    table.rows.push_back(
        {fmt::format("{:.2f}", step.place), fmt::format("{:.1f}", 100 * step.changed),
         fmt::format("{:.3f}", step.stale_error), fmt::format("{:.3f}", step.own_error),
         fmt::format("{:.3f}", step.updated_error), fmt::format("{:.3f}", step.rebuilt_error),
         fmt::format("{:.2g}", step.update_seconds), fmt::format("{:.2g}", step.rebuild_seconds),
         fmt::format("{:.2g}", step.fold_seconds), fmt::format("{:.2g}", step.frame_seconds),
         fmt::format("{:.2g}", step.dense_seconds)});
  return table;
}

void write_moved_object_json(const fs::path& file, const MovedObject& object) {
  Json steps = Json::array();
  for (const MovedObjectStep& step : object.steps)
    steps.push_back({{"place", step.place},
                     {"changed", step.changed},
                     {"update_seconds", step.update_seconds},
                     {"rebuild_seconds", step.rebuild_seconds},
                     {"fold_seconds", step.fold_seconds},
                     {"frame_seconds", step.frame_seconds},
                     {"dense_seconds", step.dense_seconds},
                     {"factor_difference", step.factor_difference},
                     {"error",
                      {{"stale", step.stale_error},
                       {"box", step.own_error},
                       {"updated", step.updated_error},
                       {"rebuilt", step.rebuilt_error}}}});
  write_json(file, {{"scene", scene_json(*object.mesh)}, {"k", object.coarse_patches}, {"steps", steps}});
}

}  // namespace

ReportSection moved_object_section(const MovedObject& object, const fs::path& strip,
                                   const std::string& command) {
  double largest = 0;
  for (const MovedObjectStep& step : object.steps) largest = std::max(largest, step.factor_difference);
  ReportSection section{"A moved object (future work of document 004)", {}};
  section.blocks.emplace_back(ReportText{fmt::format(
      "Where geometry moves, elements stay in their patches and V stays. U changes where the object is one "
      "end "
      "of a pair or may stand between its ends; the k × k matrix of Woodbury's formula takes the change up. "
      "The updated U {}.",
      largest == 0 ? std::string("equals the one computed anew in every bit")
                   : fmt::format("is the one computed anew up to {:.1g}", largest))});
  section.blocks.emplace_back(step_table(object, command));
  section.blocks.emplace_back(png_figure(strip, "B with updated factors at each place of the box.", command));
  return section;
}

ReportSection moved_object(const fs::path& folder, const std::string& command,
                           const MovedObjectOptions& options, Monitor& monitor) {
  make_folder(folder);
  const MovedObject object = measure_moved_object(options, monitor);
  write_moved_object_json(folder / "low_rank_motion.json", object);
  std::vector<Picture> pictures;
  for (std::size_t step = 0; step < object.meshes.size(); ++step)
    pictures.push_back(render_picture(*object.meshes[step], object.radiosity[step],
                                      {.width = 300, .height = 300, .interpolate = true}, monitor));
  const fs::path strip = folder / "low_rank_motion.png";
  expose_alike(pictures);
  write_drawing(strip, side_by_side(pictures));
  return moved_object_section(object, strip, command);
}

}  // namespace radiosity

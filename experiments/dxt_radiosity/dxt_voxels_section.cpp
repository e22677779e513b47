#include "experiments/dxt_radiosity/dxt_voxels.hpp"
#include "experiments/svg_plot.hpp"

#include <fmt/format.h>

#include <utility>

namespace radiosity {
namespace {

// The simplification is at fault where the light is that many times further off than averaging puts it.
constexpr double at_fault = 4;

ReportTable voxels_table(const DxtVoxels& voxels, const DxtVoxelsOptions& options,
                         const std::string& command) {
  ReportTable table{.caption = fmt::format(
                        "Relative error of indirect light over the number of voxels N, in the area norm, "
                        "against the unsimplified scene, over its own light and {} others; form factors "
                        "to {:.0e}; times of solving and transfer are those of one light.",
                        options.lights.total(), options.tolerance),
                    .command = command,
                    .columns = {"scene", "original patches", "N", "patches", "error, mean", "error, maximum",
                                "averaged only, mean", "rays leaked, %", "on backs, %", "F, MB",
                                "simplify, ms", "form factors, ms", "solve, ms", "transfer, ms"},
                    .rows = {}};
  for (const VoxelErrors& scene : voxels.scenes)
    for (const SimplificationError& error : scene.over_voxels)
      table.rows.push_back({scene.scene, std::to_string(scene.patches), std::to_string(error.wanted),
                            std::to_string(error.patches), fmt::format("{:.3f}", error.indirect.mean),
                            fmt::format("{:.3f}", error.indirect.max),
                            fmt::format("{:.3f}", error.averaged.mean),
                            scene.enclosure ? fmt::format("{:.1f}", 100 * error.leaked) : "–",
                            fmt::format("{:.1f}", 100 * error.on_backs),
                            fmt::format("{:.3f}", 1e-6 * static_cast<double>(error.factor_bytes())),
                            fmt::format("{:.1f}", 1e3 * error.simplify_seconds),
                            fmt::format("{:.0f}", 1e3 * error.form_factor_seconds),
                            fmt::format("{:.1f}", 1e3 * error.solve_seconds),
                            fmt::format("{:.1f}", 1e3 * error.transfer_seconds)});
  return table;
}

PlotPanel voxels_panel(const DxtVoxels& voxels, const std::string& title, const PlotAxis& errors,
                       IndirectErrors SimplificationError::*which) {
  PlotPanel panel{.title = title,
                  .x = {.label = "patches of the simplified scene", .scale = Scale::logarithmic},
                  .y = errors,
                  .series = {}};
  for (const VoxelErrors& scene : voxels.scenes) {
    PlotSeries series{.name = scene.scene, .points = {}};
    for (const SimplificationError& error : scene.over_voxels)
      series.points.push_back({static_cast<double>(error.patches), (error.*which).mean, 0, ""});
    panel.series.push_back(std::move(series));
  }
  return panel;
}

ReportFigure voxels_figure(const DxtVoxels& voxels, const std::string& command) {
  const PlotAxis axis{
      .label = "mean error of indirect light", .scale = Scale::logarithmic, .low = 1e-3, .high = 2};
  Plot plot;
  plot.title = "Error over voxels";
  plot.panels = {voxels_panel(voxels, "solved on voxels", axis, &SimplificationError::indirect),
                 voxels_panel(voxels, "averaged only", axis, &SimplificationError::averaged)};
  return {
      "Error of the indirect light over patches. Left: solved on the simplified scene. Right: the light "
      "of the unsimplified scene, averaged over each voxel and pulled back: what fewer patches cost where "
      "their shape does no harm.",
      command, to_svg(plot)};
}

double times_above_averaging(const VoxelErrors& errors) {
  const SimplificationError& finest = errors.over_voxels.back();
  return finest.indirect.mean / finest.averaged.mean;
}

std::string leak_text(const VoxelErrors& errors) {
  const SimplificationError& finest = errors.over_voxels.back();
  const std::string backs =
      fmt::format("{:.1f} % of the rays of {} voxels end on backs", 100 * finest.on_backs, finest.patches);
  return errors.enclosure ? fmt::format("{} and {:.1f} % leak out", backs, 100 * finest.leaked) : backs;
}

}  // namespace

std::string voxel_finding(const VoxelErrors& errors) {
  const SimplificationError &coarsest = errors.over_voxels.front(), &finest = errors.over_voxels.back();
  return fmt::format(
      "{}: from {} to {} patches the mean error falls from {:.3f} to {:.3f} (largest {:.3f}), {:.1f} times "
      "the "
      "{:.3f} of averaging alone; simplified and solved in {:.3g} s, of which form factors {:.0f} %.",
      errors.scene, coarsest.patches, finest.patches, coarsest.indirect.mean, finest.indirect.mean,
      finest.indirect.max, times_above_averaging(errors), finest.averaged.mean,
      finest.simplify_seconds + finest.form_factor_seconds + finest.solve_seconds + finest.transfer_seconds,
      100 * finest.form_factor_seconds /
          (finest.simplify_seconds + finest.form_factor_seconds + finest.solve_seconds +
           finest.transfer_seconds));
}

std::string voxel_fault_finding(const DxtVoxels& voxels) {
  std::string faults;
  for (const VoxelErrors& scene : voxels.scenes)
    if (times_above_averaging(scene) > at_fault)
      faults += fmt::format("{}{} ({:.1f} times; {})", faults.empty() ? "" : "; ", scene.scene,
                            times_above_averaging(scene), leak_text(scene));
  if (faults.empty())
    return fmt::format("No scene ends more than {} times above what averaging costs.", at_fault);
  return fmt::format(
      "The simplification itself, not the number of patches, is at fault where the error ends more than {} "
      "times above that of averaging: {}. Where a cell cuts corners of a curved surface, quads that are "
      "rectangles seen along an axis do not meet: some light passes between them, which a symmetric closure "
      "brings back in an enclosure, and some ends on the backs of others and is lost.",
      at_fault, faults);
}

ReportSection dxt_voxels_section(const DxtVoxels& voxels, const DxtVoxelsOptions& options,
                                 const std::string& command) {
  ReportSection section{"Scenes simplified to voxels: error of indirect light (document 000)", {}};
  section.blocks.emplace_back(ReportText{
      "The document solves on a scene simplified by a voxel grid (section 3.2, its reference 12) and carries "
      "the light to the original (section 3.6, step 4), but says neither how many patches that leaves nor "
      "what it costs in accuracy or time: all its errors are of the compressed matrix. It holds against "
      "voxel "
      "cone tracing that light leaks where voxels stand for geometry (section 2.3), and then rests on voxels "
      "itself. Here the unsimplified scene is the reference."});
  section.blocks.emplace_back(voxels_table(voxels, options, command));
  section.blocks.emplace_back(voxels_figure(voxels, command));
  for (const VoxelErrors& scene : voxels.scenes)
    section.blocks.emplace_back(ReportText{voxel_finding(scene)});
  section.blocks.emplace_back(ReportText{voxel_fault_finding(voxels)});
  return section;
}

}  // namespace radiosity

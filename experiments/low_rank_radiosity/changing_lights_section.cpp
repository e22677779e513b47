#include "experiments/json_objects.hpp"
#include "experiments/low_rank_radiosity/changing_lights.hpp"
#include "experiments/low_rank_radiosity/error_study_measures.hpp"
#include "experiments/low_rank_radiosity/patch_drawing.hpp"
#include "experiments/svg_plot.hpp"
#include "foundation/output_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace radiosity {
namespace {

namespace fs = std::filesystem;

constexpr double megabyte = 1e6;
constexpr double published_frames_a_second = 430;  // document 004, Section 5.4: 24128 x 1364

std::string frames_a_second(const Timing& timing) {
  return fmt::format("{:.0f} ({:.0f})", 1 / timing.min, 1 / timing.median);
}

ReportTable frame_table(const ChangingLights& lights, const std::string& command) {
  ReportTable table;
  table.caption = fmt::format(
      "Frames a second of the {} at {} × {}, at the fastest time (at the median): E of the lamps, VᵀE and B. "
      "The document has {:.0f} at 24128 × 1364. Load average {:.1f} before, {:.1f} after.",
      lights.mesh->scene->name, lights.mesh->patch_count(), lights.coarse_patches, published_frames_a_second,
      lights.load_before, lights.load_after);
  table.command = command;
  table.columns = {"method", "factors, MB", "factors made in, s"};
  for (const LightFrameTimes& times : lights.times)
    table.columns.push_back(times.threads == 1 ? "1 thread" : fmt::format("{} threads", times.threads));
  const auto channels = static_cast<double>(lights.mesh->channels());
  const auto row = [&](const std::string& name, double bytes, double seconds, Timing LightFrameTimes::*time) {
    std::vector<std::string> cells = {name, fmt::format("{:.1f}", bytes / megabyte),
                                      fmt::format("{:.2g}", lights.factor_seconds + seconds)};
    for (const LightFrameTimes& times : lights.times) cells.push_back(frames_a_second(times.*time));
    table.rows.push_back(std::move(cells));
  };
  const auto three_factors = static_cast<double>(lights.three_factor_bytes);
  row("one channel, B = E − Y (VᵀE)", three_factors / channels, lights.fold_seconds / channels,
      &LightFrameTimes::one_channel);
  row(fmt::format("{} channels, each with its Y", lights.mesh->channels()), three_factors,
      lights.fold_seconds, &LightFrameTimes::three_factors);
  row(fmt::format("{} channels, one U, a k × k matrix each", lights.mesh->channels()),
      static_cast<double>(lights.shared_factor_bytes), lights.shared_seconds,
      &LightFrameTimes::shared_factor);
  return table;
}

ReportFigure error_figure(const ChangingLights& lights, const std::string& command) {
  PlotSeries series{.name = "error in B", .points = {}, .markers = false};
  for (std::size_t t = 0; t < lights.errors.size(); ++t)
    series.points.push_back({static_cast<double>(t), lights.errors[t], 0, ""});
  Plot plot;
  plot.title = "Error of each frame";
  plot.panels.push_back({.title = "",
                         .x = {.label = "frame"},
                         .y = {.label = "relative error in B", .low = 0},
                         .series = {series}});
  return {
      fmt::format("How far B of each frame is from the dense solution: {:.3f} in the mean, {:.3f} at most.",
                  mean_of(lights.errors), *std::max_element(lights.errors.begin(), lights.errors.end())),
      command, to_svg(plot)};
}

Json timing_json(const Timing& timing) {
  return {{"min_seconds", timing.min}, {"median_seconds", timing.median}};
}

void write_changing_lights_json(const fs::path& file, const ChangingLights& lights) {
  Json times = Json::array();
  for (const LightFrameTimes& frame : lights.times)
    times.push_back({{"threads", frame.threads},
                     {"one_channel", timing_json(frame.one_channel)},
                     {"three_factors", timing_json(frame.three_factors)},
                     {"shared_factor", timing_json(frame.shared_factor)}});
  write_json(file, {{"scene", scene_json(*lights.mesh)},
                    {"k", lights.coarse_patches},
                    {"frames", lights.powers.rows()},
                    {"rays", lights.rays},
                    {"factor_seconds", lights.factor_seconds},
                    {"fold_seconds", lights.fold_seconds},
                    {"shared_seconds", lights.shared_seconds},
                    {"three_factor_bytes", lights.three_factor_bytes},
                    {"shared_factor_bytes", lights.shared_factor_bytes},
                    {"load_before", lights.load_before},
                    {"load_after", lights.load_after},
                    {"largest_disagreement", lights.largest_disagreement},
                    {"errors", lights.errors},
                    {"times", times}});
}

/// One file a picture, and some of them side by side.
void draw_frames(const fs::path& folder, const fs::path& strip, const ChangingLights& lights,
                 const ChangingLightsOptions& options, Monitor& monitor) {
  make_folder(folder);
  std::vector<Picture> pictures;
  for (const Field& B : lights.radiosity) {
    monitor.checkpoint("drawing frames",
                       static_cast<double>(pictures.size()) / static_cast<double>(lights.radiosity.size()));
    pictures.push_back(render_picture(
        *lights.mesh, B, {.width = options.width, .height = options.height, .interpolate = true}, monitor));
  }
  expose_alike(pictures);
  constexpr std::size_t most_shown = 4;
  const std::size_t shown = std::min(most_shown, pictures.size());
  std::vector<Picture> in_strip;
  for (std::size_t p = 0; p < pictures.size(); ++p)
    write_drawing(folder / fmt::format("{:04}.png", lights.drawn[p]), pictures[p]);
  for (std::size_t s = 0; s < shown; ++s) in_strip.push_back(pictures[s * pictures.size() / shown]);
  write_drawing(strip, side_by_side(in_strip));
}

}  // namespace

ReportSection changing_lights_section(const ChangingLights& lights, const fs::path& strip,
                                      const std::string& command) {
  ReportSection section{"Changing lights in a patio (document 004, Section 5.4 and Figure 4)", {}};
  section.blocks.emplace_back(ReportText{fmt::format(
      "{} lamps take turns, a lit arc going round the court one way below and the other way above. U of {} × "
      "{} comes from {:.3g} million rays in {:.3g} s. One U and a k × k matrix for each channel take {:.0f} "
      "% of "
      "the bytes of a Y for each channel, for the same answers up to {:.1g}.",
      lights.powers.cols(), lights.mesh->patch_count(), lights.coarse_patches,
      1e-6 * static_cast<double>(lights.rays), lights.factor_seconds,
      100 * static_cast<double>(lights.shared_factor_bytes) / static_cast<double>(lights.three_factor_bytes),
      lights.largest_disagreement)});
  section.blocks.emplace_back(frame_table(lights, command));
  section.blocks.emplace_back(png_figure(
      strip, fmt::format("Frames of a turn of {}: B in all bounces.", lights.powers.rows()), command));
  if (!lights.errors.empty()) section.blocks.emplace_back(error_figure(lights, command));
  return section;
}

ReportSection changing_lights(const fs::path& folder, const std::string& command,
                              const ChangingLightsOptions& options, Monitor& monitor) {
  make_folder(folder);
  const ChangingLights lights = measure_changing_lights(options, monitor);
  write_changing_lights_json(folder / "low_rank_patio.json", lights);
  const fs::path strip = folder / "low_rank_patio.png";
  draw_frames(folder / "low_rank_patio", strip, lights, options, monitor);
  return changing_lights_section(lights, strip, command);
}

}  // namespace radiosity

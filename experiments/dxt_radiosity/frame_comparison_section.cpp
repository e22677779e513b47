#include "experiments/dxt_radiosity/frame_comparison.hpp"
#include "experiments/json_objects.hpp"
#include "experiments/low_rank_radiosity/patch_drawing.hpp"
#include "experiments/svg_plot.hpp"
#include "foundation/output_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace radiosity {
namespace {

constexpr const char* frame_comparison_title =
    "One frame by several methods, and the column of Figure 13 (document 000)";
constexpr float difference_gain = 4;

/// "+1.2 / -0.3 / +0.5", %.
std::string signed_parts(const std::array<double, 3>& parts) {
  return fmt::format("{:+.1f} / {:+.1f} / {:+.1f}", 100 * parts[0], 100 * parts[1], 100 * parts[2]);
}
template <typename Parts>
std::string plain_parts(const Parts& parts) {
  return fmt::format("{:.1f} / {:.1f} / {:.1f}", 100 * parts[0], 100 * parts[1], 100 * parts[2]);
}

ReportTable frames_table(const FrameComparison& comparison, const FrameComparisonOptions& options,
                         const std::string& command) {
  ReportTable table{
      .caption = fmt::format(
          "A frame of {} x {} pixels; errors against {} paths a pixel in red / green / blue, relative to the "
          "mean of the channel, of the picture and of its pixels in shadow ({:.0f} %, where all light is "
          "indirect), the reference's noise taken out of root mean squares. Device: {}{}.",
          options.width, options.height, options.reference_paths, 100 * comparison.shadowed_part,
          comparison.renderer, comparison.software ? ", a software renderer: it computes on the CPU" : ""),
      .command = command,
      .columns = {"method", "settings", "on", "frame, ms", "mean error, %", "rms error, %",
                  "in shadow: mean, %", "in shadow: rms, %"},
      .rows = {},
      .text_columns = 3};
  for (const ComparedFrame& frame : comparison.frames)
    table.rows.push_back({frame.name, frame.settings, frame.computed_on,
                          fmt::format("{:.3g}", 1e3 * frame.seconds), signed_parts(frame.whole.mean),
                          plain_parts(frame.whole.rms), signed_parts(frame.shadowed.mean),
                          plain_parts(frame.shadowed.rms)});
  table.rows.push_back({"reference", fmt::format("{} paths a pixel", options.reference_paths), "cpu",
                        fmt::format("{:.3g}", 1e3 * comparison.reference_seconds), "–",
                        plain_parts(comparison.frames.front().whole.noise), "–",
                        plain_parts(comparison.frames.front().shadowed.noise)});
  return table;
}

ReportTable profile_table(const FrameComparison& comparison, const FrameComparisonOptions& options,
                          const std::string& command) {
  ReportTable table{
      .caption = fmt::format("Along {}: root mean square error over {} bands, relative to the mean of the "
                             "reference, red / green / blue; the slope over height of red / (red + green + "
                             "blue), by least squares.",
                             options.column, options.bands),
      .command = command,
      .columns = {"method", "profile error, %", "colour gradient, % / m", "its error, % / m"},
      .rows = {}};
  const double expected = colour_gradient(comparison.bands, comparison.reference_profile);
  for (const ComparedFrame& frame : comparison.frames) {
    const double gradient = gradient_of(comparison, frame);
    table.rows.push_back({frame.name, plain_parts(profile_error(frame.profile, comparison.reference_profile)),
                          fmt::format("{:+.2f}", 100 * gradient),
                          fmt::format("{:+.2f}", 100 * (gradient - expected))});
  }
  table.rows.push_back({"reference", "–", fmt::format("{:+.2f}", 100 * expected), "–"});
  return table;
}

PlotSeries profile_series(const std::string& name, const ColumnBands& bands, const Eigen::VectorXd& values) {
  PlotSeries series{.name = name, .points = {}};
  for (Index band = 0; band < values.size(); ++band)
    series.points.push_back({bands.height[static_cast<std::size_t>(band)], values[band], 0, ""});
  return series;
}

/// Values of the frames and the reference over height; path tracing differs from the reference by noise
/// alone.
template <typename ValuesOf>
PlotPanel profile_panel(const FrameComparison& comparison, const char* title, const PlotAxis& y,
                        const ValuesOf& values_of) {
  PlotPanel panel{.title = title, .x = {.label = "height, m"}, .y = y, .series = {}};
  for (const ComparedFrame& frame : comparison.frames)
    if (frame.name != path_tracing_name)
      panel.series.push_back(profile_series(frame.name, comparison.bands, values_of(frame.profile)));
  panel.series.push_back(
      profile_series("reference", comparison.bands, values_of(comparison.reference_profile)));
  return panel;
}

Eigen::VectorXd red_share(const Eigen::MatrixX3d& profile) {
  return profile.col(0).cwiseQuotient(profile.rowwise().sum());
}

/// Around the reference, whose gradient is small: a method far from it lies at the edge.
PlotAxis share_axis(const Eigen::VectorXd& reference) {
  constexpr double margin = 0.03;
  return {.label = "red / (red + green + blue)",
          .low = std::floor(100 * (reference.minCoeff() - margin)) / 100,
          .high = std::ceil(100 * (reference.maxCoeff() + margin)) / 100};
}

ReportFigure profile_figure(const FrameComparison& comparison, const FrameComparisonOptions& options,
                            const std::string& command) {
  Plot plot;
  plot.title = "Indirect light along the column";
  plot.panels = {
      profile_panel(
          comparison, "radiance, mean of the channels", {.label = "radiance, W/(m²sr)", .low = 0},
          [](const Eigen::MatrixX3d& profile) { return Eigen::VectorXd(profile.rowwise().mean()); }),
      profile_panel(comparison, "colour", share_axis(red_share(comparison.reference_profile)), red_share)};
  return {fmt::format("From foot to head of {}, on its side towards the nave, which the lamp does not reach. "
                      "The document shows that its method has the gradient of colour there that light "
                      "propagation volumes lose (Figure 13).",
                      options.column),
          command, to_svg(plot)};
}

std::string timing_finding(const FrameComparison& comparison) {
  const ComparedFrame& first = comparison.frames.front();
  return fmt::format(
      "Path tracing is as far off in the shadows as the compressed frame after {:.3g} paths a pixel, {:.3g} "
      "s "
      "or {:.3g} times the frame's time{}. {}Instant radiosity was given the time of that frame.",
      comparison.equal_error_paths, comparison.equal_error_seconds,
      comparison.equal_error_seconds / first.seconds,
      comparison.equal_error_paths > 0 ? "" : " (noise apart, no error is left)",
      comparison.software ? "The device is a software renderer on the same processor, so that times compare "
                            "methods, not graphics cards. "
                          : "The device is no part of the processor that traces paths: times compare both. ");
}

std::string gradient_finding(const FrameComparison& comparison) {
  const double expected = colour_gradient(comparison.bands, comparison.reference_profile);
  std::string parts;
  for (const ComparedFrame& frame : comparison.frames)
    parts += fmt::format("{}{} {:.0f} %", parts.empty() ? "" : "; ", frame.name,
                         100 * gradient_of(comparison, frame) / expected);
  return fmt::format(
      "Each frame has so much of the reference's colour gradient along the column, {:+.2f} % of red a metre: "
      "{}; "
      "below 0 it runs the other way. The compressed frames have the bounces of the naive one: what is "
      "between "
      "them is compression.",
      100 * expected, parts);
}

Json difference_json(const PictureDifference& difference) {
  return {{"mean", difference.mean},
          {"absolute", difference.absolute},
          {"rms", difference.rms},
          {"noise", difference.noise}};
}

Json comparison_json(const FrameComparison& comparison, const FrameComparisonOptions& options) {
  Json frames = Json::array();
  for (const ComparedFrame& frame : comparison.frames)
    frames.push_back(
        {{"name", frame.name},
         {"settings", frame.settings},
         {"computed_on", frame.computed_on},
         {"seconds", frame.seconds},
         {"whole", difference_json(frame.whole)},
         {"shadowed", difference_json(frame.shadowed)},
         {"profile", matrix_json(frame.profile)},
         {"profile_error", numbers_json(profile_error(frame.profile, comparison.reference_profile))},
         {"colour_gradient", gradient_of(comparison, frame)}});
  return {{"scene", scene_json(*comparison.mesh)},
          {"renderer", comparison.renderer},
          {"software", comparison.software},
          {"width", options.width},
          {"height", options.height},
          {"closest", options.closest},
          {"cells", options.cells},
          {"steps", options.steps},
          {"shadowed_part", comparison.shadowed_part},
          {"reference",
           {{"paths", options.reference_paths},
            {"seconds", comparison.reference_seconds},
            {"profile", matrix_json(comparison.reference_profile)},
            {"colour_gradient", colour_gradient(comparison.bands, comparison.reference_profile)}}},
          {"column", options.column},
          {"heights", comparison.bands.height},
          {"equal_error_paths", comparison.equal_error_paths},
          {"equal_error_seconds", comparison.equal_error_seconds},
          {"frames", frames}};
}

/// Every pixel has the mean of its block: less of the noise of paths.
Picture in_blocks(const Picture& picture) {
  constexpr int side = 4;
  Picture blocks = picture;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const int left = x / side * side, top = y / side * side;
        const int right = std::min(left + side, picture.width), bottom = std::min(top + side, picture.height);
        float sum = 0;
        for (int v = top; v < bottom; ++v)
          for (int u = left; u < right; ++u) sum += picture.pixel(u, v)[c];
        blocks.pixel(x, y)[c] = sum / static_cast<float>((right - left) * (bottom - top));
      }
  return blocks;
}

/// How far two pictures are apart, brightened.
Picture brightened_difference(const Picture& picture, const Picture& reference) {
  Picture difference = in_blocks(picture);
  const Picture expected = in_blocks(reference);
  for (std::size_t k = 0; k < difference.pixels.size(); ++k)
    difference.pixels[k] = difference_gain * std::fabs(difference.pixels[k] - expected.pixels[k]);
  return difference;
}

/// Four beside each other in the first file, the others and the reference in the second, how far each is from
/// the reference in the third, all with one exposure.
void draw_comparison(const std::array<std::filesystem::path, 3>& files, const FrameComparison& comparison) {
  std::vector<Picture> pictures = comparison.pictures;
  pictures.push_back(comparison.reference.picture);
  expose_alike(pictures);
  const auto middle = pictures.begin() + static_cast<std::ptrdiff_t>(pictures.size() / 2);
  write_drawing(files[0], side_by_side({pictures.begin(), middle}));
  write_drawing(files[1], side_by_side({middle, pictures.end()}));
  std::vector<Picture> differences;
  for (std::size_t f = 0; f < comparison.frames.size(); ++f)
    differences.push_back(brightened_difference(pictures[f], pictures.back()));
  write_drawing(files[2], side_by_side(differences));
}

std::string names_in_order(const FrameComparison& comparison, std::size_t begin, std::size_t end) {
  std::string names;
  for (std::size_t f = begin; f < end; ++f) names += (f == begin ? "" : ", ") + comparison.frames[f].name;
  return names;
}

}  // namespace

ReportSection frame_comparison_section(const FrameComparison& comparison,
                                       const FrameComparisonOptions& options, const std::string& command) {
  ReportSection section{frame_comparison_title, {}};
  section.blocks.emplace_back(ReportText{fmt::format(
      "The document shows a frame by its method, naive radiosity, light propagation volumes and path tracing "
      "(sections 4.2 and 4.3, Figures 13 and 14), and judges by eye. Here are numbers, on {} patches of the "
      "built-in colonnade in place of its Sponza, with a lamp that shines onto red cloth. Light propagation "
      "volumes and instant radiosity run on the CPU: the former with one grid and one reflection, as they "
      "were "
      "published, so that the first reflection alone is what they could reach; the latter with shadow-tested "
      "virtual lights of all bounces, 1/d² clamped at {:g} m, which "
      "loses light in corners and keeps bright spots away.",
      comparison.mesh->patch_count(), options.closest)});
  section.blocks.emplace_back(frames_table(comparison, options, command));
  section.blocks.emplace_back(ReportText{timing_finding(comparison)});
  section.blocks.emplace_back(profile_table(comparison, options, command));
  section.blocks.emplace_back(ReportText{gradient_finding(comparison)});
  section.blocks.emplace_back(profile_figure(comparison, options, command));
  return section;
}

ReportSection frame_comparison(const std::filesystem::path& folder, const std::string& command,
                               const std::shared_ptr<GlDevice>& device, const FrameComparisonOptions& options,
                               const OperatorRegistry& operators, Monitor& monitor) {
  make_folder(folder);
  const FrameComparison comparison = measure_frame_comparison(device, options, operators, monitor);
  write_json(folder / "frame_comparison.json", comparison_json(comparison, options));
  const std::array<std::filesystem::path, 3> files = {folder / "frame_comparison.png",
                                                      folder / "frame_comparison_reference.png",
                                                      folder / "frame_comparison_difference.png"};
  draw_comparison(files, comparison);
  ReportSection section = frame_comparison_section(comparison, options, command);
  const std::size_t count = comparison.frames.size(), middle = (count + 1) / 2;
  const std::array<std::string, 3> captions = {
      fmt::format("Figures 13 and 14 of the document, from the left: {}.",
                  names_in_order(comparison, 0, middle)),
      fmt::format("From the left: {}, reference.", names_in_order(comparison, middle, count)),
      fmt::format("{:g} times how far each is from the reference, in means of 4 x 4 pixels, whose noise is "
                  "still seen: {}.",
                  difference_gain, names_in_order(comparison, 0, count))};
  for (std::size_t figure = 0; figure < files.size(); ++figure)
    section.blocks.emplace_back(png_figure(files[figure], captions[figure], command));
  return section;
}

ReportSection skipped_frame_comparison(const std::string& reason) {
  return {frame_comparison_title, {ReportText{"This comparison was left out: " + reason + "."}}};
}

}  // namespace radiosity

#include "experiments/dxt_radiosity/dxt_speed.hpp"
#include "experiments/dxt_radiosity/published_errors.hpp"
#include "experiments/svg_plot.hpp"

#include <fmt/format.h>

namespace radiosity {
namespace {

constexpr double wanted_speed_ratio = 8;

double method_megabytes(const MethodSpeed& method) {
  return 1e-6 * static_cast<double>(method.bytes);
}

ReportTable speed_table(const std::vector<SpeedRound>& rounds, const std::string& caption,
                        const std::string& command) {
  ReportTable table{.caption = caption,
                    .command = command,
                    .columns = {"method", "patches", "bounces", "MB", "min, ms", "median, ms", "naive / min",
                                "naive / median", "naive / MB", "error, same bounces", "error, all", "load"},
                    .rows = {}};
  for (const SpeedRound& round : rounds) {
    const MethodSpeed& naive = round.method("naive");
    for (const MethodSpeed& method : round.methods)
      table.rows.push_back({method.name, std::to_string(round.patches),
                            method.error_of_bounces ? std::to_string(round.bounces) : "∞",
                            fmt::format("{:.2f}", method_megabytes(method)),
                            fmt::format("{:.3f}", 1e3 * method.time.min),
                            fmt::format("{:.3f}", 1e3 * method.time.median),
                            fmt::format("{:.2f}", naive.time.min / method.time.min),
                            fmt::format("{:.2f}", naive.time.median / method.time.median),
                            fmt::format("{:.2f}", method_megabytes(naive) / method_megabytes(method)),
                            method.error_of_bounces ? fmt::format("{:.2e}", *method.error_of_bounces) : "–",
                            fmt::format("{:.2e}", method.error), fmt::format("{:.1f}", round.load)});
  }
  return table;
}

template <typename Abscissa, typename Ordinate>
std::vector<PlotSeries> series_of(const std::vector<SpeedRound>& rounds, const Abscissa& x,
                                  const Ordinate& y) {
  std::vector<PlotSeries> all;
  for (std::size_t i = 0; i < rounds.front().methods.size(); ++i) {
    PlotSeries series{.name = rounds.front().methods[i].name, .points = {}};
    for (const SpeedRound& round : rounds) series.points.push_back({x(round), y(round.methods[i]), 0, ""});
    all.push_back(std::move(series));
  }
  return all;
}

double method_milliseconds(const MethodSpeed& method) {
  return 1e3 * method.time.min;
}

ReportFigure sizes_figure(const DxtSpeeds& speeds, const std::string& command) {
  const auto patches = [](const SpeedRound& round) { return static_cast<double>(round.patches); };
  const PlotAxis axis{.label = "patches", .scale = Scale::logarithmic};
  Plot plot;
  plot.title = "Time and memory";
  plot.panels = {{.title = "Figure 11",
                  .x = axis,
                  .y = {.label = "shortest time of one light, ms", .scale = Scale::logarithmic},
                  .series = series_of(speeds.over_patches, patches, method_milliseconds)},
                 {.title = "Figure 12",
                  .x = axis,
                  .y = {.label = "MB", .scale = Scale::logarithmic},
                  .series = series_of(speeds.over_patches, patches, method_megabytes)}};
  return {"Figures 11 and 12: time from E to B, and bytes that are kept for it, over patches.", command,
          to_svg(plot)};
}

ReportFigure bounces_figure(const DxtSpeeds& speeds, const std::string& command) {
  Plot plot;
  plot.title = "Time over bounces";
  plot.panels = {
      {.title = "",
       .x = {.label = "bounces k"},
       .y = {.label = "shortest time of one light, ms", .scale = Scale::logarithmic},
       .series = series_of(
           speeds.over_bounces, [](const SpeedRound& round) { return static_cast<double>(round.bounces); },
           method_milliseconds)}};
  return {
      fmt::format("Time over bounces with {} patches. The document's \"asymptotically faster\" is this: one "
                  "product whatever k is. Over patches, each is quadratic.",
                  speeds.over_bounces.front().patches),
      command, to_svg(plot)};
}

}  // namespace

std::string dxt_speed_finding(const DxtSpeeds& speeds) {
  const SpeedRound& largest = speeds.over_patches.back();
  const MethodSpeed &naive = largest.method("naive"), &sum = largest.method(document_sum);
  const double faster = naive.time.min / sum.time.min;
  const double memory = method_megabytes(naive) / method_megabytes(sum);
  const bool reached = faster >= wanted_speed_ratio && memory >= published_memory_ratio;
  return fmt::format(
      "With {} patches, {} bounces by one product with the compressed sum take {:.3f} ms, {:.1f} times less "
      "than "
      "the naive solver's {:.3f} ms (medians: {:.1f} times), and {:.2f} times less memory (the document: {} "
      "times faster, {} times less; wanted are {} times and {} times: {}). Part of the gain in time is not "
      "compression: a solver that reads F once for all channels is {:.1f} times faster than the naive one.",
      largest.patches, largest.bounces, method_milliseconds(sum), faster, method_milliseconds(naive),
      naive.time.median / sum.time.median, memory, published_speed_ratio, published_memory_ratio,
      wanted_speed_ratio, published_memory_ratio, reached ? "reached" : "not reached",
      naive.time.min / largest.method("packed").time.min);
}

std::string solver_finding(const DxtSpeeds& speeds) {
  const SpeedRound& largest = speeds.over_patches.back();
  const MethodSpeed &sum = largest.method(improved_sum), &solver = largest.method(solved_kernel);
  return fmt::format(
      "Against all bounces, {} bounces err by {:.2e} in the improved variant. Conjugate gradients on the BC4 "
      "kernel get to {:.2e} in {:.2f} times its time, with {:.2f} times less memory.",
      largest.bounces, sum.error, solver.error, solver.time.min / sum.time.min,
      method_megabytes(sum) / method_megabytes(solver));
}

ReportSection dxt_speed_section(const DxtSpeeds& speeds, const DxtSpeedOptions& options,
                                const std::string& command) {
  ReportSection section{"Form factors as a compressed texture: time and memory (document 000)", {}};
  section.blocks.emplace_back(ReportText{
      "Naive: F in float32, bounce by bounce and channel by channel. Packed: F is read once a bounce for all "
      "channels, as with four factors a texel (the document's reference 10). Colour: F^c, a matrix a "
      "channel, "
      "bounce by bounce. Sum: all bounces in one matrix, in float32 or compressed. CG: all bounces, to no "
      "more "
      "than the error of the improved sum. All of them use the same vector kernels and threads. The document "
      "gives 40 frames a second in one place and less than 17 ms in another."});
  section.blocks.emplace_back(speed_table(
      speeds.over_patches,
      fmt::format("Time from E to B of one light in {} and bytes, on {} threads; mean relative errors "
                  "of B over {} lights.",
                  options.scene, speeds.threads, options.lights.total()),
      command));
  section.blocks.emplace_back(ReportText{dxt_speed_finding(speeds)});
  section.blocks.emplace_back(ReportText{solver_finding(speeds)});
  section.blocks.emplace_back(sizes_figure(speeds, command));
  if (speeds.over_bounces.empty()) return section;
  section.blocks.emplace_back(speed_table(speeds.over_bounces, "The same over bounces.", command));
  section.blocks.emplace_back(bounces_figure(speeds, command));
  return section;
}

}  // namespace radiosity

#include "experiments/device/device_benchmark.hpp"
#include "experiments/dxt_radiosity/dxt_speed.hpp"
#include "experiments/dxt_radiosity/published_errors.hpp"
#include "experiments/svg_plot.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace radiosity {
namespace {

constexpr double wanted_speed_ratio = 8;

double method_megabytes(const MethodSpeed& method) {
  return 1e-6 * static_cast<double>(method.bytes);
}

double method_milliseconds(const MethodSpeed& method) {
  return 1e3 * method.time.min;
}

/// What is read, in words, where the name does not say.
std::string method_cell(const SpeedRound& round, const MethodSpeed& method) {
  if (method.name != "naive") return method.name;
  return fmt::format("naive: scalar F, read {} times", round.naive_reads());
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
      table.rows.push_back({method_cell(round, method), std::to_string(round.patches),
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

ReportTable reading_table(const std::vector<SpeedRound>& rounds, const std::string& command) {
  ReportTable table{
      .caption =
          "What reading alone takes: 4 n^2 bytes, summed up once in turns with the methods, for each "
          "bounce and channel of the naive solver; and at the same rate the compressed sum once. It is a "
          "bound "
          "only where F is well beyond the last cache: below 1, the cache serves F again.",
      .command = command,
      .columns = {"patches", "F, MB", "GB/s", "F read", "naive at least, ms", "naive, ms", "times that",
                  "sum, DXT, MB", "at least, ms", "sum, DXT, ms", "times that"},
      .rows = {}};
  for (const SpeedRound& round : rounds) {
    const MethodSpeed &naive = round.method("naive"), &sum = round.method(document_sum);
    const double naive_bound = round.naive_reads() * round.reading.min;
    const double sum_bound = round.seconds_to_read(static_cast<double>(sum.bytes));
    table.rows.push_back(
        {std::to_string(round.patches), fmt::format("{:.1f}", 1e-6 * round.factor_bytes()),
         fmt::format("{:.1f}", 1e-9 * round.factor_bytes() / round.reading.min),
         fmt::format("{} times", round.naive_reads()), fmt::format("{:.3f}", 1e3 * naive_bound),
         fmt::format("{:.3f}", method_milliseconds(naive)),
         fmt::format("{:.2f}", naive.time.min / naive_bound), fmt::format("{:.2f}", method_megabytes(sum)),
         fmt::format("{:.3f}", 1e3 * sum_bound), fmt::format("{:.3f}", method_milliseconds(sum)),
         fmt::format("{:.2f}", sum.time.min / sum_bound)});
  }
  return table;
}

template <typename Abscissa, typename Ordinate>
std::vector<PlotSeries> series_of(const std::vector<SpeedRound>& rounds, const Abscissa& x,
                                  const Ordinate& y) {
  std::vector<PlotSeries> all;
  for (const MethodSpeed& method : rounds.front().methods) {
    PlotSeries series{.name = method.name, .points = {}};
    for (const SpeedRound& round : rounds)
      if (const MethodSpeed* own = round.find(method.name))
        series.points.push_back({x(round), y(*own), 0, ""});
    all.push_back(std::move(series));
  }
  return all;
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

/// Figures 11 and 12 and the times over k of a graphics device.
void append_device_tables(const DxtSpeedOptions& options, const std::string& command,
                          ReportSection& section) {
  if (!options.device) return;
  const DeviceResults& device = *options.device;
  section.blocks.emplace_back(device_text(device));
  section.blocks.emplace_back(
      device_bounces_table(device, device.over_patches, "Figures 11 and 12: times and bytes", command));
  section.blocks.emplace_back(
      device_bounces_table(device, device.over_bounces, "Times over bounces", command));
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

std::string reading_finding(const DxtSpeeds& speeds) {
  const SpeedRound& largest = speeds.over_patches.back();
  const MethodSpeed &naive = largest.method("naive"), &sum = largest.method(document_sum);
  const double naive_bound = largest.naive_reads() * largest.reading.min;
  const double sum_bound = largest.seconds_to_read(static_cast<double>(sum.bytes));
  const double times = naive.time.min / naive_bound;
  return fmt::format(
      "With {} patches F takes {:.0f} MB, and to read it {} times at {:.1f} GB/s takes {:.3f} ms: the naive "
      "solver takes {:.2f} times that, {}. The compressed sum takes {:.2f} times what reading its bytes "
      "takes: "
      "the rest is decoding.",
      largest.patches, 1e-6 * largest.factor_bytes(), largest.naive_reads(),
      1e-9 * largest.factor_bytes() / largest.reading.min, 1e3 * naive_bound, times,
      times < 1 ? "as the last cache holds F from the second time on"
                : "and no solver that reads a scalar F once a bounce and channel takes less than 1",
      sum.time.min / sum_bound);
}

std::string solver_finding(const DxtSpeeds& speeds) {
  const auto both = std::find_if(speeds.over_patches.rbegin(), speeds.over_patches.rend(),
                                 [](const SpeedRound& round) { return round.find(improved_sum) != nullptr; });
  if (both == speeds.over_patches.rend()) return "";
  const SpeedRound& largest = *both;
  const MethodSpeed &sum = largest.method(improved_sum), &solver = largest.method(solved_kernel);
  return fmt::format(
      "Against all bounces, with {} patches, {} bounces err by {:.2e} in the improved variant. Conjugate "
      "gradients on the BC4 "
      "kernel get to {:.2e} in {:.2f} times its time, with {:.2f} times less memory.",
      largest.patches, largest.bounces, sum.error, solver.error, solver.time.min / sum.time.min,
      method_megabytes(sum) / method_megabytes(solver));
}

ReportSection dxt_speed_section(const DxtSpeeds& speeds, const DxtSpeedOptions& options,
                                const std::string& command) {
  ReportSection section{"Form factors as a compressed texture: time and memory (document 000)", {}};
  section.blocks.emplace_back(ReportText{
      "Naive: one scalar F in float32, 4 n^2 bytes, that all channels share, read once for each bounce and "
      "channel by a matrix-vector product; in between each channel is multiplied by its reflectance and "
      "added "
      "to B. That baseline, not a matrix of three colours, is what the document's 10 times and 3 times fit. "
      "Packed: F is read once a bounce for all channels, as with four factors a texel (the document's "
      "reference 10). Colour: F^c, a matrix a channel, bounce by bounce. Sum: all bounces in one matrix, in "
      "float32 or compressed. CG: all bounces, to no more than the error of the improved sum, or of the "
      "document's where that was not made. Each of them "
      "is "
      "timed from the call with E, n x channels in double, to the B that it leaves; all of them use the same "
      "vector kernels and threads. The document gives 40 frames a second in one place and less than 17 ms in "
      "another."});
  section.blocks.emplace_back(speed_table(
      speeds.over_patches,
      fmt::format("Time from E to B of one light in {} and bytes, on {} threads; mean relative errors "
                  "of B over {} lights.",
                  options.scene, speeds.threads, options.lights.total()),
      command));
  section.blocks.emplace_back(ReportText{dxt_speed_finding(speeds)});
  section.blocks.emplace_back(reading_table(speeds.over_patches, command));
  section.blocks.emplace_back(ReportText{reading_finding(speeds)});
  section.blocks.emplace_back(ReportText{solver_finding(speeds)});
  section.blocks.emplace_back(sizes_figure(speeds, command));
  append_device_tables(options, command, section);
  if (speeds.over_bounces.empty()) return section;
  section.blocks.emplace_back(speed_table(speeds.over_bounces, "The same over bounces.", command));
  section.blocks.emplace_back(bounces_figure(speeds, command));
  return section;
}

}  // namespace radiosity

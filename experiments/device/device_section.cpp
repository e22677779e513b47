#include "experiments/device/device_benchmark.hpp"
#include "experiments/low_rank_radiosity/low_rank_tables_cells.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace radiosity {
namespace {

std::string in_milliseconds(double seconds) {
  return fmt::format("{:.3f}", 1e3 * seconds);
}

std::string frames_a_second(const std::optional<Timing>& timing) {
  return table_number(timing ? std::optional(1 / timing->min) : std::nullopt);
}

}  // namespace

ReportText device_text(const DeviceResults& results) {
  const std::string who =
      fmt::format("{} ({}, OpenGL {}) beside {} with {} thread{}, {} sizes", results.renderer, results.vendor,
                  results.version, results.cpu, results.threads, results.threads == 1 ? "" : "s",
                  results.full ? "full" : "quick");
  if (!results.software) return {"Columns of a device are those of " + who + "."};
  return {"Columns of a device are those of " + who +
          ". This is a software renderer, which computes on the processor: its numbers show that the shaders "
          "give right results, and nothing of how fast a graphics card is."};
}

ReportTable device_frames_table(const DeviceResults& results, const std::string& command) {
  ReportTable table{
      .caption = fmt::format(
          "Frames a second on {}, B = E − Y (VᵀE) at the fastest time: with E and B on the device, with "
          "their "
          "transfers, shared with the CPU (Vᵀ E there, Y X on the device, one frame after the other), and on "
          "the CPU alone.",
          results.renderer),
      .command = command,
      .columns = {"n × k", "V", "columns", "on the device", "with transfers", "shared", "CPU",
                  "shared / faster"},
      .rows = {},
      .text_columns = 2};
  const auto add = [&](const DeviceFrames& frames, const char* name, const DeviceFrameTimes& times,
                       const Timing& hybrid, const Timing& cpu) {
    const double alone = std::min(times.with_transfers.min, cpu.min);
    table.rows.push_back({size_text(frames.size), name, std::to_string(frames.columns),
                          frames_a_second(times.frame), frames_a_second(times.with_transfers),
                          frames_a_second(hybrid), frames_a_second(cpu),
                          fmt::format("{:.2f}", alone / hybrid.min)});
  };
  for (const DeviceFrames& frames : results.frames) {
    add(frames, "sparse", frames.sparse, frames.hybrid_sparse, frames.cpu_sparse);
    if (frames.full) add(frames, "full", *frames.full, *frames.hybrid_full, *frames.cpu_full);
  }
  return table;
}

ReportTable device_bounces_table(const DeviceResults& results, const std::vector<DeviceSpeedRound>& rounds,
                                 const std::string& caption, const std::string& command) {
  ReportTable table{
      .caption = fmt::format("{} on {}, all channels of one light.", caption, results.renderer),
      .command = command,
      .columns = {"method", "patches", "bounces", "MB", "on the device, ms", "with transfers, ms",
                  "naive / on the device", "naive / MB", "from the CPU's B"},
      .rows = {}};
  for (const DeviceSpeedRound& round : rounds) {
    const DeviceMethodSpeed& naive = round.methods.front();
    for (const DeviceMethodSpeed& method : round.methods)
      table.rows.push_back(
          {method.name, std::to_string(round.patches), std::to_string(round.bounces),
           fmt::format("{:.2f}", 1e-6 * static_cast<double>(method.bytes)),
           in_milliseconds(method.on_device.min), in_milliseconds(method.with_transfers.min),
           fmt::format("{:.2f}", naive.on_device.min / method.on_device.min),
           fmt::format("{:.2f}", static_cast<double>(naive.bytes) / static_cast<double>(method.bytes)),
           fmt::format("{:.1e}", method.difference)});
  }
  return table;
}

ReportTable device_costs_table(const DeviceResults& results, const std::string& command) {
  ReportTable table{
      .caption = fmt::format("Processor seconds of a product, all threads: the CPU's kernels, and what the "
                             "process spends with {}, transfers of fields included.",
                             results.renderer),
      .command = command,
      .columns = {"product", "columns", "CPU, ms", "device, ms", "ratio", "at most, in software"},
      .rows = {}};
  for (const ProductCost& cost : results.costs)
    table.rows.push_back({cost.product, std::to_string(cost.columns), in_milliseconds(cost.cpu_seconds),
                          in_milliseconds(cost.device_cpu_seconds), fmt::format("{:.2f}", cost.ratio()),
                          fmt::format("{:.0f}", cost.limit)});
  return table;
}

ReportSection device_section(const DeviceResults& results, const std::string& command) {
  ReportSection section{"Products and frames on " + results.renderer, {}};
  section.blocks.emplace_back(device_text(results));
  section.blocks.emplace_back(device_costs_table(results, command));
  section.blocks.emplace_back(device_frames_table(results, command));
  section.blocks.emplace_back(
      device_bounces_table(results, results.over_patches, "Bounces over patches", command));
  section.blocks.emplace_back(device_bounces_table(results, results.over_bounces, "Bounces over k", command));
  return section;
}

}  // namespace radiosity

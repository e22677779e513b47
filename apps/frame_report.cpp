#include "apps/frame_report.hpp"

#include "experiments/json_objects.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>

namespace radiosity {
namespace {

Json timing_json(const Timing& timing) {
  return {{"min", timing.min}, {"median", timing.median}};
}

/// Of all stages that are not on the way to the device.
std::vector<double> device_seconds(const FrameReport& report) {
  std::vector<double> sums(report.frame_seconds.size(), 0);
  for (std::size_t stage = 1; stage < report.stage_seconds.size(); ++stage)
    for (std::size_t frame = 0; frame < sums.size(); ++frame)
      sums[frame] += report.stage_seconds[stage][frame];
  return sums;
}

Json reference_of_frame_json(const std::optional<FrameReference>& reference) {
  if (!reference) return nullptr;
  return {{"samples", reference->samples},
          {"seconds", reference->seconds},
          {"mean_difference", reference->difference.mean},
          {"mean_absolute_difference", reference->difference.absolute},
          {"rms_difference", reference->difference.rms},
          {"rms_standard_error", reference->difference.noise}};
}

}  // namespace

void print_frames(const PatchMesh& shown, const FrameReport& report) {
  fmt::print("scene      {}, {} patches, solved on {}\n", shown.scene->name, shown.patch_count(),
             report.patches);
  fmt::print("operator   {}, {} product{} a frame\n", report.operator_name, report.products,
             report.products == 1 ? "" : "s");
  fmt::print("device     {}: {}{}\n", report.device.name, report.device.renderer,
             report.device.software ? ", a software renderer: it computes on the CPU" : "");
  fmt::print("frames     {} of {} x {} pixels, {} light, exposure {:.4g}\n\n", report.frame_seconds.size(),
             report.options.width, report.options.height, report.spot ? "spot" : "point", report.exposure);
  const auto row = [](const char* name, const std::vector<double>& seconds) {
    const Timing timing = Timing::of(seconds);
    fmt::print("{:<12} {:>10.3f} {:>10.3f}\n", name, 1e3 * timing.min, 1e3 * timing.median);
  };
  fmt::print("{:<12} {:>10} {:>10}\n", "stage, ms", "min", "median");
  for (std::size_t stage = 0; stage < frame_stages.size(); ++stage)
    row(frame_stages[stage], report.stage_seconds[stage]);
  row("frame", report.frame_seconds);
  fmt::print("\n{:.4g} frames a second (median)\n", 1 / Timing::of(report.frame_seconds).median);
  if (!report.reference) return;
  const PictureDifference& difference = report.reference->difference;
  constexpr std::array<const char*, 3> colours = {"red", "green", "blue"};
  fmt::print("\nreference  {} paths a pixel in {:.3g} s; of its mean:\n", report.reference->samples,
             report.reference->seconds);
  for (std::size_t c = 0; c < colours.size(); ++c)
    fmt::print("{:<12} mean {:+.2f} %, root mean square {:.2f} % beside the reference's noise of {:.2f} %\n",
               colours[c], 100 * difference.mean[c], 100 * difference.rms[c], 100 * difference.noise[c]);
}

void write_frames_json(const std::filesystem::path& file, const PatchMesh& shown, const FrameReport& report) {
  Json stages = Json::array();
  for (std::size_t stage = 0; stage < frame_stages.size(); ++stage)
    stages.push_back(
        {{"name", frame_stages[stage]}, {"seconds", timing_json(Timing::of(report.stage_seconds[stage]))}});
  const Timing frame = Timing::of(report.frame_seconds);
  write_json(file, {{"scene", scene_json(shown)},
                    {"operator", report.operator_name},
                    {"device", device_name(report.device)},
                    {"renderer", renderer_json(report.device)},
                    {"version", report.version},
                    {"software", report.device.software},
                    {"device_difference_max", device_difference_json(report.device)},
                    {"operator_upload_seconds", report.device.upload_seconds},
                    {"patches", report.patches},
                    {"injection", report.options.injection == Injection::cube ? "cube" : "points"},
                    {"points_per_patch", report.points},
                    {"products", report.products},
                    {"light", report.spot ? "spot" : "point"},
                    {"shadow_size", report.options.shadow_size},
                    {"width", report.options.width},
                    {"height", report.options.height},
                    {"exposure", report.exposure},
                    {"frames", report.frame_seconds.size()},
                    {"stages", stages},
                    {"device_seconds", timing_json(Timing::of(device_seconds(report)))},
                    {"frame_seconds", timing_json(frame)},
                    {"frames_per_second", 1 / frame.median},
                    {"reference", reference_of_frame_json(report.reference)}});
}

}  // namespace radiosity

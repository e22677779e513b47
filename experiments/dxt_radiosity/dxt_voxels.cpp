#include "experiments/dxt_radiosity/dxt_voxels.hpp"

#include "experiments/json_objects.hpp"
#include "experiments/reference_solution.hpp"
#include "foundation/error.hpp"
#include "foundation/output_file.hpp"
#include "scene/built_in.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <utility>

namespace radiosity {
namespace {

/// The scene's own light first, if it has any, then those drawn.
Field own_and_drawn_lights(const PatchMesh& mesh, const DxtVoxelsOptions& options, Monitor& monitor) {
  Field drawn = draw_lights(mesh, options.lights, options.seed, monitor).emission;
  if (mesh.emission.isZero(0)) return drawn;
  Field lights(mesh.patch_count(), mesh.channels() + drawn.cols());
  lights << mesh.emission, drawn;
  return lights;
}

VoxelErrors measure_voxels(const VoxelStudyScene& scene, const DxtVoxelsOptions& options, Monitor& monitor) {
  const auto mesh =
      std::make_shared<const PatchMesh>(make_patches(built_in_scene(scene.spec), {.patches = scene.patches}));
  const FormFactorOptions factor_options{.tolerance = options.tolerance, .seed = options.seed};
  const FormFactors form_factors = compute_form_factors(mesh, factor_options, monitor);
  const Field emission = own_and_drawn_lights(*mesh, options, monitor);
  const std::optional<Field> radiosity = reference_solution(form_factors, emission);
  if (!radiosity) fail("no solver finds the radiosity of '{}' to compare with", scene.spec);
  VoxelErrors errors{.scene = scene.spec,
                     .patches = mesh->patch_count(),
                     .lights = emission.cols() / mesh->channels(),
                     .enclosure = mesh->topology.enclosure,
                     .form_factor_seconds = form_factors.quality.seconds,
                     .over_voxels = {}};
  for (const Index wanted : options.wanted) {
    monitor.checkpoint(fmt::format("{} on {} voxels", scene.spec, wanted), 0);
    errors.over_voxels.push_back(
        measure_simplification(form_factors, emission, *radiosity, wanted, factor_options, monitor));
  }
  return errors;
}

Json voxels_json(const SimplificationError& error) {
  return {{"wanted", error.wanted},
          {"patches", error.patches},
          {"indirect_mean", error.indirect.mean},
          {"indirect_max", error.indirect.max},
          {"averaged_mean", error.averaged.mean},
          {"averaged_max", error.averaged.max},
          {"leaked", error.leaked},
          {"on_backs", error.on_backs},
          {"factor_bytes", error.factor_bytes()},
          {"simplify_seconds", error.simplify_seconds},
          {"form_factor_seconds", error.form_factor_seconds},
          {"solve_seconds", error.solve_seconds},
          {"transfer_seconds", error.transfer_seconds}};
}

Json study_json(const DxtVoxels& voxels) {
  Json scenes = Json::array();
  for (const VoxelErrors& scene : voxels.scenes) {
    Json over_voxels = Json::array();
    for (const SimplificationError& error : scene.over_voxels) over_voxels.push_back(voxels_json(error));
    scenes.push_back({{"scene", scene.scene},
                      {"patches", scene.patches},
                      {"lights", scene.lights},
                      {"enclosure", scene.enclosure},
                      {"form_factor_seconds", scene.form_factor_seconds},
                      {"over_voxels", over_voxels}});
  }
  return {{"scenes", scenes}};
}

}  // namespace

const VoxelErrors& DxtVoxels::scene(const std::string& spec) const {
  for (const VoxelErrors& own : scenes)
    if (own.scene == spec) return own;
  fail("'{}' was not measured", spec);
}

DxtVoxels measure_dxt_voxels(const DxtVoxelsOptions& options, Monitor& monitor) {
  if (options.scenes.empty() || options.wanted.empty())
    fail<UsageError>("errors over voxels need one scene and one number of voxels at least");
  DxtVoxels voxels;
  for (const VoxelStudyScene& scene : options.scenes)
    voxels.scenes.push_back(measure_voxels(scene, options, monitor));
  return voxels;
}

ReportSection dxt_voxels(const std::filesystem::path& folder, const std::string& command,
                         const DxtVoxelsOptions& options, Monitor& monitor) {
  make_folder(folder);
  const DxtVoxels voxels = measure_dxt_voxels(options, monitor);
  write_json(folder / "dxt_voxels.json", study_json(voxels));
  return dxt_voxels_section(voxels, options, command);
}

}  // namespace radiosity

#include "apps/scene_options.hpp"

#include "apps/number_ranges.hpp"
#include "apps/scene_materials.hpp"
#include "foundation/error.hpp"
#include "scene/import.hpp"

#include <CLI/CLI.hpp>

#include <utility>

namespace radiosity {

void add_scene_options(CLI::App& command, SceneOptions& options) {
  command
      .add_option("SCENE", options.scene,
                  "a file (OBJ, PLY, STL, glTF, GLB) or a built-in name (radiosity info --list)")
      ->option_text(" ");
  CLI::Option* patches =
      command.add_option("--patches", options.patches, "cut the faces into about this many patches")
          ->check(integer_between(1, 10'000'000))
          ->option_text("N");
  command.add_option("--edge", options.edge, "cut the faces until no edge is longer, in scene units")
      ->check(number_above(0))
      ->option_text("LENGTH")
      ->excludes(patches);
  command.add_flag("--two-sided", options.two_sided, "add a reversed twin to each face");
  command
      .add_option("--reflectance", options.reflectance,
                  "the same reflectance everywhere, in place of the scene's")
      ->check(number_between(0, 1))
      ->option_text("RHO");
  command
      .add_option("--max-reflectance", options.max_reflectance,
                  "scale larger reflectances down to this, and say which")
      ->check(number_between(0, 1, false))
      ->option_text("RHO");
  command
      .add_option("--emission", options.emission_file,
                  "radiant exitance of each patch, W/m^2: an n x 1 or n x 3 .npy file")
      ->option_text("E.npy");
  command
      .add_option("--set", options.group_settings,
                  "GROUP:reflectance=R,emission=E replaces one group's; R and E are one number, or three as "
                  "0.7/0.2/0.1")
      ->expected(1, -1)
      ->allow_extra_args(false)
      ->option_text("GROUP:KEY=VALUE,...");
}

std::shared_ptr<const PatchMesh> open_mesh(const SceneOptions& options) {
  if (options.scene.empty())
    fail<UsageError>(
        "no SCENE is given: name a file or a built-in scene ('radiosity info --list' shows them)");
  Scene scene = open_scene(options.scene);
  if (options.two_sided) scene = two_sided(scene);
  PatchMesh mesh = make_patches(scene, {options.patches.value_or(0), options.edge.value_or(0)});
  apply_materials(mesh, {options.reflectance, options.emission_file, options.group_settings});
  limit_reflectance(mesh, options.max_reflectance.value_or(0));
  return std::make_shared<const PatchMesh>(std::move(mesh));
}

}  // namespace radiosity

#include "apps/simplification.hpp"

#include "experiments/json_objects.hpp"
#include "foundation/error.hpp"
#include "scene/light_transfer.hpp"

#include <CLI/CLI.hpp>

#include <charconv>
#include <string_view>

namespace radiosity {
namespace {

constexpr Index most_voxels = 10'000'000;

PatchMesh with_emission(PatchMesh mesh, const Eigen::MatrixXd& emission) {
  mesh.emission = emission;
  return mesh;
}

}  // namespace

CLI::Option* add_simplify_option(CLI::App& command, std::optional<std::string>& text) {
  return command
      .add_option("--simplify", text,
                  "solve on about N patches made from a voxel grid and light the scene from "
                  "these; --patches and --edge still cut the scene that is shown and written")
      ->option_text("voxels:N");
}

std::optional<Index> wanted_voxels(const std::optional<std::string>& option) {
  if (!option) return std::nullopt;
  const std::string& text = *option;
  constexpr std::string_view prefix = "voxels:";
  Index wanted = 0;
  const char* last = text.data() + text.size();
  const bool named = text.starts_with(prefix);
  const auto [end, error] = std::from_chars(text.data() + (named ? prefix.size() : 0), last, wanted);
  if (!named || error != std::errc{} || end != last || wanted < 1 || wanted > most_voxels)
    fail<UsageError>("--simplify {}: write it as voxels:N, with 1 to {} wanted patches", text, most_voxels);
  return wanted;
}

Simplification::Simplification(const PatchMesh& original, const Eigen::MatrixXd& emission, Index voxels)
    : lit_(with_emission(original, emission)), simplified_(simplify_to_voxels(lit_, voxels)) {
  summary_.seconds = watch_.seconds();
  summary_.triangles = triangle_count(*original.scene);
  summary_.original_patches = original.patch_count();
  summary_.patches = simplified_.mesh->patch_count();
  summary_.cell = simplified_.grid.cell();
}

Eigen::MatrixXd Simplification::patches(const Eigen::MatrixXd& irradiance) {
  const Stopwatch watch;
  Eigen::MatrixXd B = radiosity_of_patches(simplified_, lit_, irradiance);
  summary_.transfer_seconds = watch.seconds();
  return B;
}

Eigen::MatrixXd Simplification::corners(const Eigen::MatrixXd& irradiance) const {
  return radiosity_of_corners(simplified_, lit_, irradiance);
}

std::string Simplification::note() const {
  return fmt::format(
      "{} triangles became {} patches in cells of {:.3g} x {:.3g} x {:.3g}, {:.3g} s, and their light was "
      "pulled back to {} patches in {:.3g} s; factors, certificate and energy are those of the simplified "
      "scene",
      summary_.triangles, summary_.patches, summary_.cell.x(), summary_.cell.y(), summary_.cell.z(),
      summary_.seconds, summary_.original_patches, summary_.transfer_seconds);
}

}  // namespace radiosity

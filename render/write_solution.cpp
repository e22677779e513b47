#include "render/write_solution.hpp"

#include "foundation/error.hpp"
#include "foundation/npy.hpp"
#include "render/glb_export.hpp"
#include "render/image_file.hpp"
#include "render/ply_export.hpp"
#include "render/tone_mapping.hpp"

#include <algorithm>
#include <cctype>

namespace radiosity {
namespace {

std::string extension_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::string write_picture(const std::filesystem::path& file, const Picture& picture) {
  if (extension_of(file) == ".exr") {
    write_exr(file, picture);
    return fmt::format("wrote {}: {} x {} pixels, linear radiance in W/(m^2 sr)", file.string(),
                       picture.width, picture.height);
  }
  const double exposure = exposure_of(picture);
  write_png(file, picture.width, picture.height, tone_mapped(picture, exposure));
  return fmt::format("wrote {}: {} x {} pixels, sRGB of radiance times {:.4g}", file.string(), picture.width,
                     picture.height, exposure);
}

std::string write_mesh(const std::filesystem::path& file, const PatchMesh& mesh, const Eigen::MatrixXd& B) {
  const double exposure = exposure_of(B, mesh.area);
  if (extension_of(file) == ".glb")
    write_glb(file, mesh, B, exposure);
  else
    write_ply(file, mesh, B, exposure);
  return fmt::format("wrote {}: {} patches, colours are radiance times {:.4g}", file.string(),
                     mesh.patch_count(), exposure);
}

}  // namespace

const std::vector<SolutionFormat>& solution_formats() {
  static const std::vector<SolutionFormat> formats = {
      {".glb", "patches with flat colours, binary glTF 2.0"},
      {".ply", "patches with flat colours"},
      {".exr", "picture from the scene's camera, linear float32"},
      {".png", "picture from the scene's camera, tone-mapped to 8 bit sRGB"},
      {".npy", "the radiosity itself, n x channels, for NumPy"},
  };
  return formats;
}

void check_solution_format(const std::filesystem::path& file) {
  std::string known;
  for (const SolutionFormat& format : solution_formats()) {
    if (format.extension == extension_of(file)) return;
    known += (known.empty() ? "" : ", ") + format.extension;
  }
  fail<UsageError>("cannot write '{}': its extension is none of {}", file.string(), known);
}

std::string write_solution(const std::filesystem::path& file, const PatchMesh& mesh, const Eigen::MatrixXd& B,
                           const PictureOptions& picture, Monitor& monitor, const Eigen::MatrixXd& corners) {
  check_solution_format(file);
  const std::string extension = extension_of(file);
  if (B.rows() != mesh.patch_count())
    fail<UsageError>("cannot write '{}': the solution has {} rows and the scene {} patches", file.string(),
                     B.rows(), mesh.patch_count());
  if (extension == ".npy") {
    write_npy(file, B);
    return fmt::format("wrote {}: radiosity in W/m^2, {} x {}", file.string(), B.rows(), B.cols());
  }
  if (B.cols() != 1 && B.cols() != 3)
    fail<UsageError>("cannot write '{}': colours need 1 or 3 channels, not {}", file.string(), B.cols());
  if (extension == ".exr" || extension == ".png")
    return write_picture(file, render_picture(mesh, B, picture, monitor, corners));
  return write_mesh(file, mesh, B);
}

}  // namespace radiosity

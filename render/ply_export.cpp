#include "render/ply_export.hpp"

#include "foundation/output_file.hpp"
#include "render/tone_mapping.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <numbers>
#include <ostream>
#include <string>

namespace radiosity {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

template <typename T>
void put(std::ostream& stream, T value) {
  stream.write(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string header(std::size_t vertices, std::size_t faces, double exposure) {
  return fmt::format(
      "ply\n"
      "format binary_little_endian 1.0\n"
      "comment colours: sRGB of radiosity / pi times {}\n"
      "element vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "element face {}\n"
      "property list uchar int vertex_indices\n"
      "property double radiosity_red\nproperty double radiosity_green\nproperty double radiosity_blue\n"
      "end_header\n",
      exposure, vertices, faces);
}

}  // namespace

void write_ply(const std::filesystem::path& file, const PatchMesh& mesh, const Eigen::MatrixXd& B,
               double exposure) {
  const auto channel = [&B](Index patch, Index c) { return B(patch, B.cols() == 3 ? c : 0); };
  std::size_t vertices = 0;
  for (const Patch& patch : mesh.patches) vertices += static_cast<std::size_t>(patch.corner_count);

  OutputFile output(file);
  std::ostream& stream = output.stream();
  stream << header(vertices, mesh.patches.size(), exposure);
  for (Index i = 0; i < mesh.patch_count(); ++i)
    for (int k = 0; k < mesh.patches[static_cast<std::size_t>(i)].corner_count; ++k) {
      for (const double coordinate : mesh.corner(i, k)) put(stream, coordinate);
      for (Index c = 0; c < 3; ++c) put(stream, srgb_byte(exposure * channel(i, c) / std::numbers::pi));
    }
  std::int32_t next = 0;
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const int corners = mesh.patches[static_cast<std::size_t>(i)].corner_count;
    put(stream, static_cast<std::uint8_t>(corners));
    for (int k = 0; k < corners; ++k) put(stream, next++);
    for (Index c = 0; c < 3; ++c) put(stream, channel(i, c));
  }
  output.commit();
}

}  // namespace radiosity

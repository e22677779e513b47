#include "experiments/low_rank_radiosity/cube_meshes.hpp"

#include "foundation/error.hpp"
#include "scene/built_in.hpp"
#include "scene/coarse_mesh.hpp"
#include "scene/patch_division.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace radiosity {
namespace {

constexpr Index cube_faces = 6;

bool is_square(Index number) {
  const auto root = static_cast<Index>(std::llround(std::sqrt(static_cast<double>(number))));
  return number > 0 && root * root == number;
}

PatchMesh cube_of_squares(Index count) {
  PatchMesh mesh = make_patches(built_in_scene("cube"), {.patches = count});
  if (mesh.patch_count() != count) fail("the cube came in {} patches, not {}", mesh.patch_count(), count);
  return mesh;
}

PatchMesh halve_squares(const PatchMesh& squares) {
  std::vector<std::vector<Polygon>> parts(squares.scene->faces.size());
  for (auto& face : parts) face.reserve(static_cast<std::size_t>(2 * squares.patch_count() / cube_faces));
  for (Index p = 0; p < squares.patch_count(); ++p) {
    auto [near, far] = cut_quad(polygon_of(squares, p), 0, 0.5);
    auto& face = parts[static_cast<std::size_t>(squares.patches[static_cast<std::size_t>(p)].face)];
    face.push_back(std::move(near));
    face.push_back(std::move(far));
  }
  return mesh_of_parts(squares, std::move(parts));
}

}  // namespace

PatchMesh cube_mesh(Index count) {
  if (count % cube_faces == 0 && is_square(count / cube_faces)) return cube_of_squares(count);
  if (count % (2 * cube_faces) == 0 && is_square(count / (2 * cube_faces)))
    return halve_squares(cube_of_squares(count / 2));
  fail<UsageError>("a cube of {} equal patches: choose 6 m^2 or 12 m^2", count);
}

}  // namespace radiosity

#include "scene/built_in_geometry.hpp"
#include "scene/rectilinear_space.hpp"
#include "scene/scene_builder.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

namespace radiosity {
namespace {

// Cells seen from above and from the side, as colonnade_space() has them.
constexpr int kLeftAisle = 0, kLeftColumns = 1, kNave = 2, kRightColumns = 3;
constexpr int kClothLayer = 0, kRoofLayer = 2;
constexpr int kMiddleBay = 4, kLastBay = 8;
constexpr int kColumnsOfRow = 4;

bool in_row_of_columns(const RectilinearSpace::Cell& cell) {
  return cell[2] == kLeftColumns || cell[2] == kRightColumns;
}

bool beside_column(const RectilinearSpace::Cell& cell) {
  return cell[0] % 2 == 1;
}

bool is_open_in_colonnade(const RectilinearSpace::Cell& cell) {
  if (cell[2] == kNave) return true;
  return cell[1] != kRoofLayer && !(in_row_of_columns(cell) && beside_column(cell));
}

// Document 000 shows a coloured Sponza, which is a model of many thousand triangles; this has what its Figure
// 13 is about: columns beside coloured cloth under an open sky. Metres, all of them multiples of 1/4.
RectilinearSpace colonnade_space() {
  const std::vector<double> along = {0, 2, 2.5, 4.5, 5, 7, 7.5, 9.5, 10, 12};  // bays between columns
  const std::vector<double> across = {0, 2, 2.5, 6, 6.5, 8.5};  // aisle, columns, nave, columns, aisle
  const std::vector<double> up = {0, 2.5, 4, 4.75};             // cloth, wall above it, roof
  return {{along, up, across}, is_open_in_colonnade};
}

struct ColonnadeMaterials {
  explicit ColonnadeMaterials(SceneBuilder& builder)
      : plaster(builder.material({"plaster", {0.72, 0.70, 0.66}, Color::Zero()})),
        stone(builder.material({"stone", {0.68, 0.66, 0.62}, Color::Zero()})),
        paving(builder.material({"paving", {0.45, 0.44, 0.42}, Color::Zero()})),
        red_cloth(builder.material({"red cloth", {0.62, 0.07, 0.06}, Color::Zero()})),
        blue_cloth(builder.material({"blue cloth", {0.08, 0.14, 0.55}, Color::Zero()})),
        canopy(builder.material({"canopy", {0.70, 0.72, 0.74}, Color::Zero()})),
        lamp(builder.material({"lamp", {0.80, 0.80, 0.80}, {44, 38, 29}})) {}

  int plaster, stone, paving, red_cloth, blue_cloth, canopy, lamp;
};

struct ColonnadeSurface {
  std::string group;
  int material = 0;
};

std::string side_name(const RectilinearSpace::Cell& cell) {
  return cell[2] < kNave ? "left" : "right";
}

ColonnadeSurface level_part(const RectilinearWall& wall, const ColonnadeMaterials& materials) {
  if (wall.faces_up) return {"floor", materials.paving};
  if (wall.cell[2] == kNave) return {"sky", materials.canopy};
  if (in_row_of_columns(wall.cell)) return {"lintels", materials.stone};
  if (wall.cell[0] == kMiddleBay) return {side_name(wall.cell) + "/lamp", materials.lamp};
  return {"ceiling", materials.plaster};
}

ColonnadeSurface upright_part(const RectilinearWall& wall, const ColonnadeMaterials& materials) {
  RectilinearSpace::Cell behind = wall.cell;
  behind[static_cast<std::size_t>(wall.axis)] += wall.faces_up ? -1 : 1;
  if (behind[0] < 0 || behind[0] > kLastBay) return {"ends", materials.plaster};
  if (in_row_of_columns(behind)) {
    if (wall.cell[1] == kRoofLayer) return {"lintels", materials.stone};
    const int column = (behind[0] + 1) / 2 + (behind[2] == kRightColumns ? kColumnsOfRow : 0);
    return {fmt::format("column{}", column), materials.stone};
  }
  if (wall.cell[1] == kClothLayer && !beside_column(wall.cell))
    return wall.cell[2] == kLeftAisle ? ColonnadeSurface{"left/cloth", materials.red_cloth}
                                      : ColonnadeSurface{"right/cloth", materials.blue_cloth};
  return {side_name(wall.cell) + "/wall", materials.plaster};
}

}  // namespace

Scene make_colonnade(Spec& spec) {
  const bool open = spec.choice("sky", "open", {"open", "closed"}) == "open";
  SceneBuilder builder(spec.name());
  const ColonnadeMaterials materials(builder);
  for (int column = 1; column <= 2 * kColumnsOfRow; ++column)
    builder.group(fmt::format("column{}", column));  // so they are listed in order
  for (const RectilinearWall& wall : walls_of(colonnade_space())) {
    const ColonnadeSurface part =
        wall.axis == 1 ? level_part(wall, materials) : upright_part(wall, materials);
    if (open && part.group == "sky") continue;
    builder.face(wall.corners, part.material, builder.group(part.group));
  }
  Scene scene = std::move(builder.scene());
  scene.contacts = Contacts::never;
  scene.conforming = true;
  scene.camera = Camera{{1.2, 1.8, 3.1}, {7.5, 2.1, 5.4}, Vector3::UnitY(), 62.0};
  return scene;
}

}  // namespace radiosity

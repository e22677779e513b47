#include "scene/built_in_geometry.hpp"
#include "scene/rectilinear_space.hpp"
#include "scene/scene_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace radiosity {
namespace {

// Document 004 (figure 4) tells of its patio that it has two floors and 24128 patches; the measures are ours.
// Metres, all of them multiples of 1/4: with the court open the surfaces are 1508 m^2, which is 24128 squares
// of that side.
constexpr double kPillar = 0.75;   // square; also how thick the parapets are
constexpr double kBay = 2.5;       // between two pillars
constexpr double kGallery = 2.5;   // between the pillars and the walls
constexpr double kGround = 3.75;   // clear height
constexpr double kUpper = 3.5;     // clear height
constexpr double kLintel = 0.75;   // the upper floor with the lintels that carry it; the roof likewise
constexpr double kParapet = 1.25;  // height

// Seen from above, cells alternate: gallery, pillar, bay, pillar, bay, pillar, bay, pillar, gallery.
constexpr int kFirstPillar = 1, kLastPillar = 7, kLastCell = 8;

constexpr int kLamps = 16;

/// The layers of cells, from below.
enum Layer { kGroundStorey, kUpperSlab, kParapets, kUpperStorey, kRoof };

enum class Place { gallery, pillar, between_pillars, court };

Place place_of(const RectilinearSpace::Cell& cell) {
  const auto [nearest, furthest] = std::minmax(cell[0], cell[2]);
  if (nearest < kFirstPillar || furthest > kLastPillar) return Place::gallery;
  if (nearest > kFirstPillar && furthest < kLastPillar) return Place::court;
  return cell[0] % 2 == 1 && cell[2] % 2 == 1 ? Place::pillar : Place::between_pillars;
}

bool is_open(const RectilinearSpace::Cell& cell) {
  const Place place = place_of(cell);
  if (place == Place::court) return true;
  if (cell[1] == kParapets) return place == Place::gallery;
  return (cell[1] == kGroundStorey || cell[1] == kUpperStorey) && place != Place::pillar;
}

std::vector<double> running_sums(std::initializer_list<double> widths) {
  std::vector<double> planes = {0};
  for (const double width : widths) planes.push_back(planes.back() + width);
  return planes;
}

RectilinearSpace patio_space() {
  const std::vector<double> plan =
      running_sums({kGallery, kPillar, kBay, kPillar, kBay, kPillar, kBay, kPillar, kGallery});
  return {{{plan, running_sums({kGround, kLintel, kParapet, kUpper - kParapet, kLintel}), plan}}, is_open};
}

/// 1 to 16, if the ceiling of this cell is a lamp: across the gallery from the pillars in the middle of each
/// side to the wall, two a side and eight a storey.
std::optional<int> lamp_in(const RectilinearSpace::Cell& cell) {
  const auto is_middle_pillar = [](int at) { return at == 3 || at == 5; };
  const auto is_end = [](int at) { return at == 0 || at == kLastCell; };
  const int storey = cell[1] == kGroundStorey ? 0 : 1;
  for (const int across : {0, 2}) {
    const int end = cell[static_cast<std::size_t>(across)],
              along = cell[static_cast<std::size_t>(2 - across)];
    if (!is_end(end) || !is_middle_pillar(along)) continue;
    const int side = across + (end == 0 ? 0 : 1);
    return 8 * storey + 2 * side + (along == 3 ? 1 : 2);
  }
  return std::nullopt;
}

std::string lamp_name(int number) {
  return fmt::format("lamp{}", number);
}

struct PatioMaterials {
  explicit PatioMaterials(SceneBuilder& builder)
      : plaster(builder.material({"plaster", {0.76, 0.66, 0.50}, Color::Zero()})),
        whitewash(builder.material({"whitewash", {0.82, 0.80, 0.75}, Color::Zero()})),
        stone(builder.material({"stone", {0.64, 0.58, 0.49}, Color::Zero()})),
        tiles(builder.material({"tiles", {0.52, 0.27, 0.17}, Color::Zero()})),
        paving(builder.material({"paving", {0.42, 0.40, 0.37}, Color::Zero()})),
        canopy(builder.material({"canopy", {0.70, 0.72, 0.74}, Color::Zero()})),
        lamp(builder.material({"lamp", {0.80, 0.80, 0.80}, {44, 38, 29}})) {}

  int plaster, whitewash, stone, tiles, paving, canopy, lamp;
};

struct Surface {
  std::string group;
  int material = 0;
};

/// "ground/" or "upper/", the storey that a layer is part of.
std::string storey_of(int layer) {
  return layer == kGroundStorey || layer == kUpperSlab ? "ground/" : "upper/";
}

/// Floors, ceilings and what is like them, by the cell that they bound.
Surface level_surface(const RectilinearWall& wall, const PatioMaterials& materials) {
  const Place place = place_of(wall.cell);
  const std::string storey = storey_of(wall.cell[1]);
  if (place == Place::court)
    return wall.faces_up ? Surface{"court", materials.paving} : Surface{"sky", materials.canopy};
  if (!wall.faces_up) {
    const std::optional<int> lamp = lamp_in(wall.cell);
    return lamp ? Surface{lamp_name(*lamp), materials.lamp}
                : Surface{storey + "ceiling", materials.whitewash};
  }
  if (place == Place::between_pillars && wall.cell[1] == kUpperStorey)
    return {storey + "parapets", materials.whitewash};
  return {storey + "floor", materials.tiles};
}

/// What stands upright, by the solid behind it.
Surface upright_surface(const RectilinearWall& wall, const PatioMaterials& materials) {
  const std::string storey = storey_of(wall.cell[1]);
  if (wall.cell[1] == kUpperSlab || wall.cell[1] == kRoof) return {storey + "lintels", materials.stone};
  RectilinearSpace::Cell behind = wall.cell;
  behind[static_cast<std::size_t>(wall.axis)] += wall.faces_up ? -1 : 1;
  const Place solid = place_of(behind);
  if (solid == Place::pillar) return {storey + "pillars", materials.stone};
  if (solid == Place::between_pillars) return {storey + "parapets", materials.whitewash};
  return {storey + "walls", materials.plaster};
}

}  // namespace

Scene make_patio(Spec& spec) {
  const bool open = spec.choice("sky", "open", {"open", "closed"}) == "open";
  SceneBuilder builder(spec.name());
  const PatioMaterials materials(builder);
  for (int lamp = 1; lamp <= kLamps; ++lamp) builder.group(lamp_name(lamp));  // so they are listed in order
  for (const RectilinearWall& wall : walls_of(patio_space())) {
    const Surface surface =
        wall.axis == 1 ? level_surface(wall, materials) : upright_surface(wall, materials);
    if (open && surface.group == "sky") continue;
    builder.face(wall.corners, surface.material, builder.group(surface.group));
  }
  Scene scene = std::move(builder.scene());
  scene.contacts = Contacts::never;
  scene.conforming = true;
  scene.camera = Camera{{3.7, 3.4, 11.8}, {9.4, 3.9, 5.2}, Vector3::UnitY(), 78.0};
  return scene;
}

}  // namespace radiosity

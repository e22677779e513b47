#include "scene/box_faces.hpp"
#include "scene/built_in_geometry.hpp"
#include "scene/rectilinear_space.hpp"
#include "scene/scene_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace radiosity {
namespace {

// Along x and z: gallery, pillar, opening, pillar, opening, pillar, gallery. The ring of pillars and openings
// is the arcade; the court lies inside of it.
constexpr double kGallery = 3, kPillar = 0.6, kOpening = 2.4;
constexpr int kFirst = 1, kLast = 5;

/// From the ground upwards.
enum Level { ground, lintel, slab, parapet, upper, cornice };
constexpr std::array<double, 6> kHeights = {3, 0.4, 0.4, 1, 2, 0.6};

constexpr double kLampSide = 0.5, kLampHeight = 2.2;  // of its middle above the floor

std::vector<double> planes_after(const std::vector<double>& lengths) {
  std::vector<double> planes = {0};
  for (const double length : lengths) planes.push_back(planes.back() + length);
  return planes;
}

const std::vector<double>& plan() {
  static const std::vector<double> planes =
      planes_after({kGallery, kPillar, kOpening, kPillar, kOpening, kPillar, kGallery});
  return planes;
}

enum class Zone { gallery, arcade, court };

Zone zone_of(const RectilinearSpace::Cell& cell) {
  const auto outside = [](int at) { return at < kFirst || at > kLast; };
  const auto on_ring = [](int at) { return at == kFirst || at == kLast; };
  if (outside(cell[0]) || outside(cell[2])) return Zone::gallery;
  return on_ring(cell[0]) || on_ring(cell[2]) ? Zone::arcade : Zone::court;
}

bool is_free(const RectilinearSpace::Cell& cell) {
  const int level = cell[1];
  switch (zone_of(cell)) {
    case Zone::court:
      return true;
    case Zone::gallery:
      return level == ground || level == parapet || level == upper;
    case Zone::arcade:
      break;
  }
  // Every second cell of the ring is an opening, from its corners on.
  return (cell[0] + cell[2]) % 2 != 0 && (level == ground || level == upper);
}

/// What a wall is: the floor it belongs to, then its part.
std::string part_of(const RectilinearWall& wall) {
  const bool court = zone_of(wall.cell) == Zone::court;
  const int level = wall.cell[1];
  const std::string floor = level < parapet ? "ground/" : "upper/";
  if (wall.axis == 1) {
    if (!wall.faces_up) return floor + "ceiling";
    if (court) return "court";
    return floor + (zone_of(wall.cell) == Zone::arcade && level == upper ? "parapet" : "floor");
  }
  RectilinearSpace::Cell behind = wall.cell;
  behind[static_cast<std::size_t>(wall.axis)] += wall.faces_up ? -1 : 1;
  if (zone_of(behind) == Zone::gallery) return floor + "walls";  // the outermost
  if (level == lintel || level == slab || level == cornice) return floor + "beams";
  return floor + (level == parapet ? "parapet" : "pillars");
}

struct PatioMaterials {
  int stone, plaster, tiles, marble;

  int of(const std::string& part) const {
    const std::string kind = part.substr(part.find('/') + 1);
    if (kind == "court" || kind == "floor") return part == "court" ? stone : tiles;
    return kind == "walls" || kind == "ceiling" ? plaster : marble;
  }
};

void add_lamps(SceneBuilder& builder) {
  const double middle = 0.5 * plan().back(), beside = 0.5 * kGallery;
  const double upstairs = kHeights[ground] + kHeights[lintel] + kHeights[slab];
  const std::array<Vector3, 4> places = {{{middle, kLampHeight, beside},
                                          {middle, kLampHeight, 2 * middle - beside},
                                          {beside, upstairs + kLampHeight, middle},
                                          {2 * middle - beside, upstairs + kLampHeight, middle}}};
  int number = 0;
  for (const Vector3& place : places) {
    const std::string name = fmt::format("lamp{}", ++number);
    const int material = builder.material({name, Color::Constant(0.5), {110, 85, 55}});
    const int group = builder.group(name);
    for (const std::vector<Vector3>& face : box_seen_from_outside(place, cube_halves(kLampSide)))
      builder.face(face, material, group);
  }
}

}  // namespace

Scene make_patio(Spec& spec) {
  SceneBuilder builder(spec.name());
  PatioMaterials materials{};
  materials.stone = builder.material({"stone", {0.42, 0.38, 0.33}, Color::Zero()});
  materials.plaster = builder.material({"plaster", {0.78, 0.72, 0.6}, Color::Zero()});
  materials.tiles = builder.material({"tiles", {0.55, 0.26, 0.16}, Color::Zero()});
  materials.marble = builder.material({"marble", {0.7, 0.68, 0.64}, Color::Zero()});

  RectilinearSpace space;
  space.planes = {plan(), planes_after({kHeights.begin(), kHeights.end()}), plan()};
  space.is_free = is_free;
  for (const RectilinearWall& wall : walls_of(space)) {
    const bool sky = wall.axis == 1 && !wall.faces_up && wall.cell[1] == cornice;
    if (sky) continue;
    const std::string part = part_of(wall);
    builder.face(wall.corners, materials.of(part), builder.group(part));
  }
  add_lamps(builder);

  Scene scene = std::move(builder.scene());
  scene.box_like = true;
  scene.contacts = Contacts::never;
  scene.camera = Camera{{4.0, 5.6, 4.0}, {8.2, 3.1, 8.6}, Vector3::UnitY(), 80.0};
  return scene;
}

}  // namespace radiosity

#include "foundation/error.hpp"
#include "scene/built_in_geometry.hpp"
#include "scene/grey_materials.hpp"
#include "scene/rectilinear_space.hpp"
#include "scene/scene_builder.hpp"

#include <algorithm>

namespace radiosity {
namespace {

constexpr double kWallThickness = 0.05;
constexpr double kLeastOpening = 0.001;  // narrower would be lost among the tolerances of a chain of rooms

/// The rectangular opening in each wall between two rooms.
struct Opening {
  const char* name = "door";
  double low = 0, high = 0;  // y
  double width = 0;          // centred in z; 0: none
};

struct Chain {
  int rooms = 2;
  Opening opening;
  int closed = 0;  // the opening behind this room is walled up
};

/// 0, the numbers between 0 and 1, 1.
std::vector<double> unit_interval_cut_at(std::initializer_list<double> cuts) {
  std::vector<double> planes = {0};
  for (const double cut : cuts)
    if (cut > planes.back() && cut < 1) planes.push_back(cut);
  planes.push_back(1);
  return planes;
}

/// Cells along x alternate between rooms and the walls behind them.
RectilinearSpace space_of(const Chain& chain) {
  RectilinearSpace space;
  const Opening& opening = chain.opening;
  for (int room = 0; room < chain.rooms; ++room) {
    const double begin = room * (1 + kWallThickness);
    space.planes[0].push_back(begin);
    space.planes[0].push_back(begin + 1);
  }
  const bool any = opening.width > 0 && chain.rooms > 1;
  space.planes[1] = any ? unit_interval_cut_at({opening.low, opening.high}) : unit_interval_cut_at({});
  space.planes[2] = any ? unit_interval_cut_at({0.5 * (1 - opening.width), 0.5 * (1 + opening.width)})
                        : unit_interval_cut_at({});
  const int opening_y = opening.low > 0 ? 1 : 0, opening_z = opening.width < 1 ? 1 : 0;
  space.is_free = [any, opening_y, opening_z, closed = chain.closed](const RectilinearSpace::Cell& cell) {
    if (cell[0] % 2 == 0) return true;
    return any && cell[0] / 2 + 1 != closed && cell[1] == opening_y && cell[2] == opening_z;
  };
  return space;
}

std::string group_of(const RectilinearWall& wall, const Opening& opening) {
  const std::string room = fmt::format("room{}/", wall.cell[0] / 2 + 1);
  if (wall.cell[0] % 2 == 1) return room + opening.name;
  if (wall.axis != 1) return room + "walls";
  return room + (wall.faces_up ? "floor" : "ceiling");
}

Scene make_chain(Spec& spec, const Chain& chain) {
  SceneBuilder builder(spec.name());
  const GreyMaterials materials = GreyMaterials::add(builder, spec);
  for (const RectilinearWall& wall : walls_of(space_of(chain))) {
    const std::string group = group_of(wall, chain.opening);
    builder.face(wall.corners, group == "room1/ceiling" ? materials.light : materials.grey,
                 builder.group(group));
  }
  Scene scene = std::move(builder.scene());
  scene.contacts = Contacts::never;
  scene.conforming = true;
  scene.camera = Camera{{0.02, 0.6, 0.6}, {1.0, 0.4, 0.48}, Vector3::UnitY(), 75.0};
  return scene;
}

int room_count(Spec& spec) {
  return static_cast<int>(spec.integer("n", 2, 1, 64));
}

}  // namespace

Scene make_rooms(Spec& spec) {
  Chain chain;
  chain.rooms = room_count(spec);
  const double side = spec.number("door", 0.3, 0, 1);
  if (side > 0 && side < kLeastOpening)
    fail<UsageError>("'{}': door={} is too narrow; give 0 for no doors, or {} to 1", spec.text(), side,
                     kLeastOpening);
  chain.opening = {"door", 0, side, side};
  chain.closed = static_cast<int>(spec.integer("closed", 0, 0, chain.rooms - 1));
  return make_chain(spec, chain);
}

Scene make_keyhole(Spec& spec) {
  const double width = spec.number("width", 0.02, kLeastOpening, 1);
  const double height = spec.number("height", 0.1, kLeastOpening, 1);
  return make_chain(spec, {2, {"keyhole", 0.5 * (1 - height), 0.5 * (1 + height), width}, 0});
}

Scene make_disconnected_rooms(Spec& spec) {
  return make_chain(spec, {room_count(spec), {}, 0});
}

Scene make_l_room(Spec& spec) {
  SceneBuilder builder(spec.name());
  const GreyMaterials materials = GreyMaterials::add(builder, spec);
  const RectilinearSpace space = {
      {{{0, 1, 2.2}, {0, 0.9}, {0, 0.8, 2}}},
      [](const RectilinearSpace::Cell& cell) { return cell[0] == 0 || cell[2] == 0; }};
  for (const RectilinearWall& wall : walls_of(space)) {
    const bool lit = wall.axis == 1 && !wall.faces_up && wall.cell[0] == 1;
    const char* level = wall.faces_up ? "floor" : "ceiling";
    builder.face(wall.corners, lit ? materials.light : materials.grey,
                 builder.group(lit ? "light" : (wall.axis == 1 ? level : "walls")));
  }
  Scene scene = std::move(builder.scene());
  scene.contacts = Contacts::never;
  scene.conforming = true;
  scene.camera = Camera{{0.5, 0.45, 1.98}, {0.6, 0.4, 0.4}, Vector3::UnitY(), 75.0};
  return scene;
}

}  // namespace radiosity

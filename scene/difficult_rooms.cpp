#include "scene/box_faces.hpp"
#include "scene/built_in_geometry.hpp"
#include "scene/grey_materials.hpp"
#include "scene/rectilinear_space.hpp"
#include "scene/scene_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace radiosity {
namespace {

/// Seen from just inside the front of a cube of side 1.
Scene room_of(SceneBuilder& builder) {
  Scene scene = std::move(builder.scene());
  scene.contacts = Contacts::never;
  scene.conforming = true;
  scene.camera = Camera{{0.5, 0.5, 0.99}, {0.5, 0.5, 0.0}, Vector3::UnitY(), 75.0};
  return scene;
}

}  // namespace

Scene make_slivers(Spec& spec) {
  SceneBuilder builder(spec.name());
  const GreyMaterials materials = GreyMaterials::add(builder, spec);
  const double aspect = spec.number("aspect", 1e6, 2, 1e6);
  const RectilinearSpace space = {
      {{{0, 0.25, 0.25 + 1e-3, 0.7, 0.7 + std::min(1 / aspect, 0.25), 1}, {0, 1}, {0, 1}}},
      [](const RectilinearSpace::Cell&) { return true; }};
  for (const RectilinearWall& wall : walls_of(space)) {
    const bool ceiling = wall.axis == 1 && !wall.faces_up;
    const bool sliver = wall.axis != 0 && (wall.cell[0] == 1 || wall.cell[0] == 3);
    builder.face(wall.corners, ceiling ? materials.light : materials.grey,
                 builder.group(sliver ? "slivers" : "room"));
  }
  return room_of(builder);
}

Scene make_flawed_room(Spec& spec) {
  SceneBuilder builder(spec.name());
  const GreyMaterials materials = GreyMaterials::add(builder, spec);
  BoxFaces box = box_seen_from_inside(Vector3::Constant(0.5), cube_halves(1));
  const std::vector<Vector3> floor = box[0];
  const auto add = [&](const std::vector<Vector3>& corners, const char* group) {
    builder.face(corners, std::string(group) == "ceiling" ? materials.light : materials.grey,
                 builder.group(group));
  };
  for (std::size_t k = 0; k < 6; ++k) {
    const std::string side = kBoxSides[k];
    if (side == "right") std::reverse(box[k].begin(), box[k].end());
    add(box[k], side == "right" ? "flipped" : kBoxSides[k]);
  }
  add({{0.2, 0.5, 0.5}, {0.3, 0.5, 0.5}, {0.4, 0.5, 0.5}}, "zero-area");
  add(floor, "duplicate");
  add({{0, 0, 0}, {0, 0, 1}, {0.5, 0.5, 1}, {0.5, 0.5, 0}}, "fin");
  return room_of(builder);
}

Scene make_uneven_areas(Spec&) {
  SceneBuilder builder("uneven-areas");
  // 1 - reflectance falls from 0.99 to 0.001 in equal ratios.
  const auto material = [&](int step) {
    const double rho = 1 - 0.99 * std::pow(0.001 / 0.99, step / 6.0);
    return builder.material({fmt::format("grey{}", step + 1), Color::Constant(rho), Color::Zero()});
  };
  for (int step = 0; step < 6; ++step) {
    const double side = std::pow(10.0, step - 3);
    // Each beside the smaller ones, in another direction. The smallest is at the centre, where coordinates in
    // single precision are finest.
    Vector3 centre = Vector3::Zero();
    if (step > 0) centre[(step - 1) % 3] = (step % 2 == 1 ? 1 : -1) * side;
    const int grey = material(step), group = builder.group(fmt::format("cube{}", step + 1));
    for (const std::vector<Vector3>& face : box_seen_from_outside(centre, cube_halves(side)))
      builder.face(face, grey, group);
  }
  const BoxFaces walls = box_seen_from_inside(Vector3::Zero(), cube_halves(1000));
  const int grey = material(6);
  const int light = builder.material({"light", Color::Constant(0.999), Color::Ones()});
  for (std::size_t k = 0; k < 6; ++k)
    builder.face(walls[k], k == 1 ? light : grey, builder.group(kBoxSides[k]));
  Scene scene = room_of(builder);
  scene.camera = Camera{{0, 0, 495}, {0, 0, 0}, Vector3::UnitY(), 75.0};
  return scene;
}

}  // namespace radiosity

#include "scene/box_faces.hpp"
#include "scene/built_in_geometry.hpp"
#include "scene/grey_materials.hpp"
#include "scene/scene_builder.hpp"

#include <cmath>
#include <numbers>

namespace radiosity {
namespace {

/// Seen from outside, in front and above.
Scene open_scene_of(SceneBuilder& builder, const Vector3& target) {
  Scene scene = std::move(builder.scene());
  scene.contacts = Contacts::never;
  scene.camera = Camera{target + Vector3(0.8, 1.6, 2.6), target, Vector3::UnitY(), 39.3077};
  return scene;
}

void add_open_box(SceneBuilder& builder, const GreyMaterials& materials) {
  const BoxFaces box = box_seen_from_inside(Vector3::Constant(0.5), cube_halves(1));
  for (std::size_t k = 0; k < 6; ++k) {
    const std::string side = kBoxSides[k];
    if (side == "ceiling") continue;
    builder.face(box[k], side == "floor" ? materials.light : materials.grey, builder.group(side));
  }
}

}  // namespace

Scene make_wedge(Spec& spec) {
  SceneBuilder builder(spec.name());
  const GreyMaterials materials = GreyMaterials::add(builder, spec);
  const double angle = spec.number("angle", 90, 1, 179) / 180 * std::numbers::pi;
  const Vector3 far(std::cos(angle), std::sin(angle), 0);
  builder.face({{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, materials.grey, builder.group("floor"));
  builder.face({{0, 0, 0}, far, far + Vector3::UnitZ(), {0, 0, 1}}, materials.light, builder.group("light"));
  Scene scene = open_scene_of(builder, {0.3, 0.2, 0.5});
  scene.conforming = true;
  return scene;
}

Scene make_facing_plates(Spec& spec) {
  SceneBuilder builder(spec.name());
  const GreyMaterials materials = GreyMaterials::add(builder, spec);
  const double y = spec.number("distance", 1, 0.001, 1000);
  builder.face({{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, materials.grey, builder.group("plate"));
  builder.face({{0, y, 0}, {1, y, 0}, {1, y, 1}, {0, y, 1}}, materials.light, builder.group("light"));
  Scene scene = open_scene_of(builder, {0.5, 0, 0.5});
  scene.box_like = true;
  return scene;
}

Scene make_open_box(Spec& spec) {
  SceneBuilder builder(spec.name());
  add_open_box(builder, GreyMaterials::add(builder, spec));
  Scene scene = open_scene_of(builder, Vector3::Constant(0.5));
  scene.box_like = true;
  return scene;
}

Scene make_isolated_patch(Spec& spec) {
  SceneBuilder builder(spec.name());
  const GreyMaterials materials = GreyMaterials::add(builder, spec);
  add_open_box(builder, materials);
  const double y = -0.5;
  builder.face({{0, y, 0}, {1, y, 0}, {1, y, 1}, {0, y, 1}}, materials.light, builder.group("isolated"));
  Scene scene = open_scene_of(builder, Vector3::Constant(0.5));
  scene.box_like = true;
  return scene;
}

Scene make_flat(Spec& spec) {
  SceneBuilder builder(spec.name());
  const GreyMaterials materials = GreyMaterials::add(builder, spec);
  builder.face({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, materials.light, builder.group("flat"));
  return open_scene_of(builder, {0.3, 0, 0.3});
}

}  // namespace radiosity

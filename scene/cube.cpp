#include "scene/built_in_geometry.hpp"
#include "scene/scene_builder.hpp"

namespace radiosity {

Scene make_cube(Spec&) {
  SceneBuilder builder("cube");
  const int grey = builder.material({"grey", Color::Constant(0.5), Color::Zero()});
  const int light = builder.material({"light", Color::Constant(0.5), Color::Ones()});
  builder.face({{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, grey, builder.group("floor"));
  builder.face({{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}, light, builder.group("ceiling"));
  builder.face({{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, grey, builder.group("left"));
  builder.face({{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}}, grey, builder.group("right"));
  builder.face({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, grey, builder.group("back"));
  builder.face({{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, grey, builder.group("front"));
  Scene scene = std::move(builder.scene());
  scene.box_like = true;
  // Just inside the front wall, wide enough to see the other five.
  scene.camera = Camera{{0.5, 0.5, 0.99}, {0.5, 0.5, 0.0}, Vector3::UnitY(), 75.0};
  return scene;
}

}  // namespace radiosity

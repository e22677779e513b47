#include "scene/built_in_geometry.hpp"
#include "scene/cornell_spectra.hpp"
#include "scene/scene_builder.hpp"
#include "scene/spectrum.hpp"

#include <array>

namespace radiosity {
namespace {

// Radiant exitance of the light, weighted by luminance: W/m^2. Cornell publishes only its relative spectrum;
// about pi x 12.7, the brightness of the light in pictures of the box that are exposed for it.
constexpr double kLightExitance = 40;

/// Millimetres of the measurement to metres. x runs from right to left for the camera, y up, z into the box.
Vector3 millimetres(double x, double y, double z) {
  return Vector3(x, y, z) / 1000;
}

struct Room {
  double floor_width_front, floor_width_back, ceiling_width;  // x, in mm
};
constexpr double kHeight = 548.8, kDepth = 559.2;
constexpr Room kMeasured = {552.8, 549.6, 556.0};
constexpr Room kPlanar = {556.0, 556.0, 556.0};

struct Palette {
  int white, red, green, light;
};

Palette add_materials(SceneBuilder& builder) {
  const Color spectrum = linear_srgb(cornell_light());
  const Color emission = spectrum * (kLightExitance / (spectrum * luminance_weights()).sum());
  return {builder.material({"white", linear_srgb(cornell_white()), Color::Zero()}),
          builder.material({"red", linear_srgb(cornell_red()), Color::Zero()}),
          builder.material({"green", linear_srgb(cornell_green()), Color::Zero()}),
          builder.material({"light", Color::Constant(0.78), emission})};
}

/// The ceiling, facing down, as a frame of eight rectangles around the light that fills its hole.
void add_ceiling(SceneBuilder& builder, const Room& room, const Palette& palette) {
  const std::array<double, 4> x = {0, 213, 343, room.ceiling_width};
  const std::array<double, 4> z = {0, 227, 332, kDepth};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const bool hole = i == 1 && k == 1;
      builder.face({millimetres(x[i], kHeight, z[k]), millimetres(x[i + 1], kHeight, z[k]),
                    millimetres(x[i + 1], kHeight, z[k + 1]), millimetres(x[i], kHeight, z[k + 1])},
                   hole ? palette.light : palette.white, builder.group(hole ? "light" : "ceiling"));
    }
}

void add_room(SceneBuilder& builder, const Room& room, const Palette& palette) {
  const Vector3 front_left = millimetres(room.floor_width_front, 0, 0);
  const Vector3 back_left = millimetres(room.floor_width_back, 0, kDepth);
  const Vector3 front_right = millimetres(0, 0, 0), back_right = millimetres(0, 0, kDepth);
  const Vector3 front_left_top = millimetres(room.ceiling_width, kHeight, 0);
  const Vector3 back_left_top = millimetres(room.ceiling_width, kHeight, kDepth);
  const Vector3 front_right_top = millimetres(0, kHeight, 0),
                back_right_top = millimetres(0, kHeight, kDepth);

  builder.face({front_left, front_right, back_right, back_left}, palette.white, builder.group("floor"));
  add_ceiling(builder, room, palette);
  builder.face({back_left, back_right, back_right_top, back_left_top}, palette.white, builder.group("back"));
  const int left = builder.group("left");
  if (room.floor_width_front == room.ceiling_width) {
    builder.face({front_left, back_left, back_left_top, front_left_top}, palette.red, left);
  } else {  // the four measured corners are not coplanar
    builder.face({front_left, back_left, back_left_top}, palette.red, left);
    builder.face({front_left, back_left_top, front_left_top}, palette.red, left);
  }
  builder.face({back_right, front_right, front_right_top, back_right_top}, palette.green,
               builder.group("right"));
}

/// A block on the floor without a bottom; `footprint` in mm, x and z, counter-clockwise seen from above.
void add_block(SceneBuilder& builder, const std::array<std::array<double, 2>, 4>& footprint, double height,
               int material, int group) {
  std::vector<Vector3> bottom, top;
  for (const auto& [x, z] : footprint) {
    bottom.push_back(millimetres(x, 0, z));
    top.push_back(millimetres(x, height, z));
  }
  builder.face(top, material, group);
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    builder.face({bottom[k], bottom[next], top[next], top[k]}, material, group);
  }
}

void add_blocks(SceneBuilder& builder, const Palette& palette) {
  add_block(builder, {{{130, 65}, {82, 225}, {240, 272}, {290, 114}}}, 165, palette.white,
            builder.group("short-block"));
  add_block(builder, {{{423, 247}, {265, 296}, {314, 456}, {472, 406}}}, 330, palette.white,
            builder.group("tall-block"));
}

Scene finish(SceneBuilder& builder) {
  Scene scene = std::move(builder.scene());
  scene.contacts = Contacts::always;
  scene.camera = Camera{millimetres(278, 273, -800), millimetres(278, 273, 0), Vector3::UnitY(), 39.3077};
  scene.notes.push_back("Cornell's measurement in metres (published in millimetres)");
  return scene;
}

}  // namespace

Scene make_cornell_box(Spec&) {
  SceneBuilder builder("cornell-box");
  const Palette palette = add_materials(builder);
  add_room(builder, kMeasured, palette);
  add_blocks(builder, palette);
  return finish(builder);
}

Scene make_closed_cornell_box(Spec&) {
  SceneBuilder builder("cornell-box-closed");
  const Palette palette = add_materials(builder);
  add_room(builder, kPlanar, palette);
  const double width = kPlanar.ceiling_width;
  builder.face({millimetres(0, 0, 0), millimetres(width, 0, 0), millimetres(width, kHeight, 0),
                millimetres(0, kHeight, 0)},
               palette.white, builder.group("front"));
  add_blocks(builder, palette);
  return finish(builder);
}

}  // namespace radiosity

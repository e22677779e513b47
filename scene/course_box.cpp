#include "scene/built_in_geometry.hpp"
#include "scene/scene_builder.hpp"

#include <array>

namespace radiosity {
namespace {

constexpr double kSide = 555;

using Corners = std::array<Vector3, 8>;  // A ... D on the floor, E ... H above them

/// Triangles named by the letters of their corners, the front where they run counter-clockwise.
void add_triangles(SceneBuilder& builder, const Corners& corners, const std::vector<const char*>& triangles,
                   int material, const char* group) {
  const auto corner = [&](char letter) { return corners[static_cast<std::size_t>(letter - 'A')]; };
  for (const char* name : triangles)
    builder.face({corner(name[0]), corner(name[1]), corner(name[2])}, material, builder.group(group));
}

void add_block(SceneBuilder& builder, const std::array<std::array<double, 2>, 4>& footprint, double height,
               int material, const char* group) {
  Corners corners;
  for (std::size_t k = 0; k < 4; ++k) {
    corners[k] = {footprint[k][0], 0, footprint[k][1]};
    corners[k + 4] = {footprint[k][0], height, footprint[k][1]};
  }
  add_triangles(builder, corners, {"ABE", "BFE", "BDF", "DHF", "DCH", "CGH", "CEG", "CAE", "EFG", "FHG"},
                material, group);
}

}  // namespace

// The Cornell box as a graphics course simplified it: 30 triangles, plane walls of side 555, blocks without
// bottoms, no light (give one with --set). Document 003 counts 192, 304, 464 and 784 patches on it:
// Subdivision{.edge = 130, .passes = 3 ... 6}.
Scene make_course_box(Spec&) {
  SceneBuilder builder("course-box");
  const auto colour = [&](const char* name, double r, double g, double b) {
    return builder.material({name, Color(r, g, b), Color::Zero()});
  };
  const int red = colour("red", 0.75, 0.15, 0.15), yellow = colour("yellow", 0.75, 0.75, 0.15);
  const int green = colour("green", 0.15, 0.75, 0.15), cyan = colour("cyan", 0.15, 0.75, 0.75);
  const int blue = colour("blue", 0.15, 0.15, 0.75), purple = colour("purple", 0.75, 0.15, 0.75);
  const int white = colour("white", 0.75, 0.75, 0.75);
  const Corners room = {{{kSide, 0, 0},
                         {0, 0, 0},
                         {kSide, 0, kSide},
                         {0, 0, kSide},
                         {kSide, kSide, 0},
                         {0, kSide, 0},
                         {kSide, kSide, kSide},
                         {0, kSide, kSide}}};
  add_triangles(builder, room, {"ABC", "BDC"}, green, "floor");
  add_triangles(builder, room, {"CEA", "GEC"}, purple, "left");
  add_triangles(builder, room, {"DBF", "DFH"}, yellow, "right");
  add_triangles(builder, room, {"GFE", "GHF"}, cyan, "ceiling");
  add_triangles(builder, room, {"CDG", "DHG"}, white, "back");
  add_block(builder, {{{290, 114}, {130, 65}, {240, 272}, {82, 225}}}, 165, red, "short-block");
  add_block(builder, {{{423, 247}, {265, 296}, {472, 406}, {314, 456}}}, 330, blue, "tall-block");
  Scene scene = std::move(builder.scene());
  scene.contacts = Contacts::never;
  scene.camera = Camera{{278, 273, -800}, {278, 273, 0}, Vector3::UnitY(), 39.3077};
  return scene;
}

}  // namespace radiosity

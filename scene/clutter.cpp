#include "foundation/random.hpp"
#include "scene/box_faces.hpp"
#include "scene/built_in_geometry.hpp"
#include "scene/scene_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiosity {
namespace {

constexpr double kGap = 0.01;  // between boxes, and to the walls
constexpr double kSmallestEdge = 0.1, kLargestEdge = 0.25;
constexpr std::int64_t kUsualCount = 12;

/// A box inside of the upright cylinder that it can be turned in.
struct FloatingBox {
  Vector3 centre;
  std::array<Vector3, 3> half;
  double radius = 0;  // of the cylinder

  double half_height() const { return half[1].norm(); }
};

FloatingBox random_box(RandomStream& random, double scale) {
  FloatingBox box;
  std::array<double, 3> size{};
  for (double& half : size) half = 0.5 * scale * random.uniform(kSmallestEdge, kLargestEdge);
  const double angle = random.uniform(0, 0.5 * std::numbers::pi);
  box.half = {size[0] * Vector3(std::cos(angle), 0, -std::sin(angle)), size[1] * Vector3::UnitY(),
              size[2] * Vector3(std::sin(angle), 0, std::cos(angle))};
  box.radius = std::hypot(size[0], size[2]);
  const auto coordinate = [&](double extent) { return random.uniform(extent + kGap, 1 - extent - kGap); };
  box.centre.x() = coordinate(box.radius);
  box.centre.y() = coordinate(box.half_height());
  box.centre.z() = coordinate(box.radius);
  return box;
}

bool apart(const FloatingBox& a, const FloatingBox& b) {
  const Vector3 offset = a.centre - b.centre;
  return std::abs(offset.y()) > a.half_height() + b.half_height() + kGap ||
         std::hypot(offset.x(), offset.z()) > a.radius + b.radius + kGap;
}

/// More boxes than usual are smaller, so that the part of the room that they fill stays and a place is soon
/// found.
std::vector<FloatingBox> random_boxes(std::int64_t count, std::uint64_t seed) {
  RandomStream random(seed);
  const double scale = std::min(
      1.0, std::cbrt(static_cast<double>(kUsualCount) / static_cast<double>(std::max(count, kUsualCount))));
  std::vector<FloatingBox> boxes;
  while (static_cast<std::int64_t>(boxes.size()) < count) {
    const FloatingBox candidate = random_box(random, scale);
    if (std::all_of(boxes.begin(), boxes.end(),
                    [&](const FloatingBox& other) { return apart(candidate, other); }))
      boxes.push_back(candidate);
  }
  return boxes;
}

}  // namespace

// The colours are those of the Cornell box that PBRT-v4 comes with.
Scene make_clutter(Spec& spec) {
  SceneBuilder builder(spec.name());
  const Color rho = Color::Constant(spec.number("reflectance", 0.73, 0, 1));
  const int white = builder.material({"white", rho, Color::Zero()});
  const int light = builder.material({"light", rho, Color::Ones()});
  const int red = builder.material({"red", {0.63, 0.065, 0.05}, Color::Zero()});
  const int green = builder.material({"green", {0.14, 0.45, 0.091}, Color::Zero()});
  const std::array<int, 6> materials = {white, light, red, green, white, white};
  const BoxFaces room = box_seen_from_inside(Vector3::Constant(0.5), cube_halves(1));
  for (std::size_t k = 0; k < 6; ++k) builder.face(room[k], materials[k], builder.group(kBoxSides[k]));

  const std::int64_t count = spec.integer("boxes", kUsualCount, 0, 100);
  const auto seed = static_cast<std::uint64_t>(spec.integer("seed", 1, 0, 1'000'000'000));
  int number = 0;
  for (const FloatingBox& box : random_boxes(count, seed)) {
    const int group = builder.group(fmt::format("box{}", ++number));
    for (const std::vector<Vector3>& face : box_seen_from_outside(box.centre, box.half))
      builder.face(face, white, group);
  }
  Scene scene = std::move(builder.scene());
  scene.contacts = Contacts::never;
  scene.conforming = true;
  scene.camera = Camera{{0.5, 0.5, 0.995}, {0.5, 0.5, 0.0}, Vector3::UnitY(), 75.0};
  return scene;
}

}  // namespace radiosity

// View factors checked by others: ../shared/reference/view-factors.csv, read from where it lies.
#include "tests/form_factors/hand_made_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <string>

namespace radiosity::testing {
namespace {

std::map<std::string, double> reference_values() {
  std::map<std::string, double> values;
  std::ifstream in(RADIOSITY_SOURCE_DIR "/../shared/reference/view-factors.csv");
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    const auto name = line.substr(0, line.find(','));
    values[name] = std::stod(line.substr(line.rfind(',') + 1));
  }
  return values;
}

HandMadeScene squares(double distance, double length = 1) {
  HandMadeScene scene;
  scene.rectangle({0, 0, 0}, length * kX, kY).rectangle({0, 0, distance}, kY, length * kX);
  return scene;
}

HandMadeScene corner(double from, double depth, double height) {
  HandMadeScene scene;
  scene.rectangle({from, 0, 0}, depth * kX, kY).rectangle({0, 0, 0}, kY, height * kZ);
  return scene;
}

HandMadeScene wedge(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  HandMadeScene scene;
  scene.rectangle({0, 0, 0}, kX, kY).rectangle({0, 0, 0}, kY, Vector3(std::cos(angle), 0, std::sin(angle)));
  return scene;
}

HandMadeScene screened(const Vector3& from, double size, double square = 1) {
  HandMadeScene scene;
  scene.rectangle({0, 0, 0}, square * kX, square * kY).rectangle({0, 0, 1}, square * kY, square * kX);
  scene.rectangle(from, size * kX, size * kY);
  return scene;
}

using MakeScene = std::function<HandMadeScene()>;

const std::map<std::string, MakeScene>& unobstructed_cases() {
  static const std::map<std::string, MakeScene> cases = {
      {"parallel unit squares distance 1", [] { return squares(1); }},
      {"parallel unit squares distance 0.5", [] { return squares(0.5); }},
      {"parallel unit squares distance 0.1", [] { return squares(0.1); }},
      {"parallel unit squares distance 2", [] { return squares(2); }},
      {"parallel 2x1 rectangles distance 1", [] { return squares(1, 2); }},
      {"perpendicular unit squares sharing an edge", [] { return corner(0, 1, 1); }},
      {"perpendicular sharing an edge receiver height 2", [] { return corner(0, 1, 2); }},
      {"perpendicular sharing an edge emitter depth 2", [] { return corner(0, 2, 1); }},
      {"perpendicular without a shared edge", [] { return corner(1, 1, 1); }},
      {"parallel shifted by 1 in x distance 1",
       [] {
         HandMadeScene scene;
         scene.rectangle({0, 0, 0}, kX, kY).rectangle({1, 0, 1}, kY, kX);
         return scene;
       }},
      {"wedge of unit squares 30 degrees", [] { return wedge(30); }},
      {"wedge of unit squares 60 degrees", [] { return wedge(60); }},
  };
  return cases;
}

const std::map<std::string, MakeScene>& blocked_cases() {
  static const std::map<std::string, MakeScene> cases = {
      {"blocked: screen [0;0.5]^2 at z=0.5 between unit squares at distance 1",
       [] {
         return screened({0, 0, 0.5}, 0.5);
       }},
      {"blocked: centred 0.5 screen at z=0.5",
       [] {
         return screened({0.25, 0.25, 0.5}, 0.5);
       }},
      {"blocked: half plane x<0.5 at z=0.5",
       [] {
         return screened({-19.5, -10, 0.5}, 20);
       }},
      {"blocked: 2x2 squares distance 1 centred 1x1 screen in the middle",
       [] {
         return screened({0.5, 0.5, 0.5}, 1, 2);
       }},
      {"blocked: full unit screen in the middle",
       [] {
         return screened({0, 0, 0.5}, 1);
       }},
  };
  return cases;
}

// Area-weighted form factor between the first two faces, each its own group.
double group_factor(const PatchMesh& mesh, const FormFactors& form_factors) {
  double exchange = 0, area = 0;
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    if (mesh.patches[static_cast<std::size_t>(i)].group != 0) continue;
    area += mesh.area[i];
    for (Index j = 0; j < mesh.patch_count(); ++j)
      if (mesh.patches[static_cast<std::size_t>(j)].group == 1) exchange += mesh.area[i] * form_factors(i, j);
  }
  return exchange / area;
}

void compare(const std::map<std::string, MakeScene>& cases, double tolerance, double edge, double allowed) {
  const auto values = reference_values();
  if (values.empty())
    GTEST_SKIP() << "the reference values are not there (../shared/reference/view-factors.csv)";
  for (const auto& [name, make] : cases) {
    ASSERT_TRUE(values.contains(name)) << name;
    HandMadeScene scene = make();
    const auto mesh = scene.mesh({.edge = edge});
    const double value = group_factor(*mesh, compute(mesh, raw(tolerance)));
    const double reference = values.at(name);
    EXPECT_LE(std::abs(value - reference), allowed * reference)
        << name << ", longest edge " << edge << ": " << value;
  }
}

TEST(ReferenceValues, UnobstructedAtDefaults) {
  compare(unobstructed_cases(), 1e-4, 0, 1e-5);
}
TEST(ReferenceValues, UnobstructedAtDefaultsInManyPatches) {
  compare(unobstructed_cases(), 1e-4, 0.2, 1e-5);
}
TEST(ReferenceValues, UnobstructedRefined) {
  compare(unobstructed_cases(), 1e-7, 0, 1e-6);
}
TEST(ReferenceValues, BlockedAtDefaults) {
  compare(blocked_cases(), 1e-4, 0, 2e-3);
}
TEST(ReferenceValues, BlockedAtDefaultsInManyPatches) {
  compare(blocked_cases(), 1e-4, 0.2, 2e-3);
}

}  // namespace
}  // namespace radiosity::testing

#include "scene/import.hpp"
#include "scene/patch_mesh.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>

namespace radiosity {
namespace {

/// What the note beside each scene says of it.
struct SharedScene {
  const char* file;
  std::size_t triangles;
  bool closed;
  double area;
};

void PrintTo(const SharedScene& scene, std::ostream* out) {
  *out << scene.file;
}

class SharedScenes : public testing::TestWithParam<SharedScene> {};

TEST_P(SharedScenes, LoadAsTheirNotesSay) {
  const std::filesystem::path file =
      std::filesystem::path(RADIOSITY_SOURCE_DIR) / "../shared/scenes" / GetParam().file;
  if (!std::filesystem::exists(file))
    GTEST_SKIP() << "no " << file << ": scenes of others are not part of the project";
  const Scene scene = import_scene(file);
  std::size_t triangles = 0;
  double area = 0;
  for (const Face& face : scene.faces) {
    triangles += static_cast<std::size_t>(face.corner_count) - 2;
    area += area_vector(scene, face).norm();
  }
  EXPECT_EQ(triangles, GetParam().triangles);
  EXPECT_NEAR(area / GetParam().area, 1, 1e-5);
  EXPECT_EQ(topology(scene).closed, GetParam().closed);
  EXPECT_GT(make_patches(scene).patch_count(), 0);
}

INSTANTIATE_TEST_SUITE_P(
    Files, SharedScenes,
    testing::Values(SharedScene{"asteroid-eros/asteroid-eros.obj", 7790, true, 1118.4},
                    SharedScene{"bitterli-cornell-box/bitterli-cornell-box.obj", 36, false, 25.9547},
                    SharedScene{"breakfast-room/breakfast-room.obj", 269538, false, 957.826},
                    SharedScene{"city-delft/city-delft.obj", 36271, false, 77526.1},
                    SharedScene{"citygml-lod4-building/citygml-lod4-building.obj", 2968, false, 413.952},
                    SharedScene{"cornell-original/embree/cornell_box.obj", 34, false, 1975960},
                    SharedScene{"cornell-original/mcguire/CornellBox-Sphere.obj", 2188, false, 20.6407},
                    SharedScene{"cornell-original/mcguire/CornellBox-Water.obj", 7088, false, 25.3776},
                    SharedScene{"freedoom-e1m1/freedoom-e1m1.obj", 5364, false, 21960200},
                    SharedScene{"freedoom-e1m2/freedoom-e1m2.obj", 10818, true, 17175600},
                    SharedScene{"ifc-fzk-haus/ifc-fzk-haus.obj", 35906, false, 2271.5},
                    SharedScene{"modern-hall/modern-hall.obj", 31087, false, 1191.89}));

TEST(SharedScenesGlb, AllLoad) {
  const std::filesystem::path folder = std::filesystem::path(RADIOSITY_SOURCE_DIR) / "../shared/scenes";
  int loaded = 0;
  for (const char* name : {"cornell-glb", "kenney-city-kit"}) {
    if (!std::filesystem::exists(folder / name)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(folder / name)) {
      const auto extension = entry.path().extension();
      if (extension != ".glb" && extension != ".ply") continue;
      EXPECT_GT(make_patches(import_scene(entry.path())).patch_count(), 0) << entry.path();
      ++loaded;
    }
  }
  if (loaded == 0) GTEST_SKIP() << "no " << folder << ": scenes of others are not part of the project";
}

}  // namespace
}  // namespace radiosity

#include "foundation/error.hpp"
#include "sample_files.hpp"
#include "scene/import.hpp"
#include "scene/patch_mesh.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace radiosity {
namespace {

bool has_note(const Scene& scene, const std::string& text) {
  return std::any_of(scene.notes.begin(), scene.notes.end(),
                     [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

TEST(ImportObj, KeepsQuadsGroupsMaterialsAndDoubles) {
  const TemporaryFolder folder;
  folder.write("sample.mtl", sample_mtl());
  const Scene scene = import_scene(folder.write("sample.obj", sample_obj()));
  EXPECT_EQ(scene.name, "sample");
  ASSERT_EQ(scene.faces.size(), 2U);
  EXPECT_EQ(scene.faces[0].corner_count, 4);
  EXPECT_EQ(scene.faces[1].corner_count, 3);
  EXPECT_EQ(scene.groups, (std::vector<std::string>{"floor", "lamp"}));
  ASSERT_EQ(scene.materials.size(), 2U);
  EXPECT_TRUE((scene.materials[0].reflectance == Color(0.2, 0.4, 0.6)).all());
  EXPECT_TRUE((scene.materials[0].emission == 0).all());
  EXPECT_LT((scene.materials[1].emission - std::numbers::pi * Color(1, 2, 3)).abs().maxCoeff(), 1e-14);
  EXPECT_TRUE(area_vector(scene, scene.faces[0]).isApprox(Vector3(0, 0, 2)));
  EXPECT_TRUE(area_vector(scene, scene.faces[1]).isApprox(Vector3(0, -1.5, 0)));
  EXPECT_TRUE(scene.notes.empty());
}

TEST(ImportObj, ReadsCoordinatesCorrectlyRounded) {
  const TemporaryFolder folder;
  const Scene scene = import_scene(
      folder.write("a.obj", "v 0.1 84879.123456789012 1e-17\nv 1 0 0\nv 0 +1 0 # up\nf 1 2 3 # all\n"));
  EXPECT_EQ(scene.vertices[0], Vector3(0.1, 84879.123456789012, 1e-17));
}

TEST(ImportObj, NamesGroupsByGroupThenObjectThenMaterial) {
  const TemporaryFolder folder;
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const auto groups = [&](const std::string& rest) {
    return import_scene(folder.write("a.obj", vertices + rest)).groups;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(groups("f 1 2 3\n"), (Names{"default"}));
  EXPECT_EQ(groups("usemtl red\nf 1 2 3\n"), (Names{"red"}));
  EXPECT_EQ(groups("o thing\nusemtl red\nf 1 2 3\n"), (Names{"thing"}));
  EXPECT_EQ(groups("g part\no thing\nusemtl red\nf 1 2 3\n"), (Names{"part"}));
  // Equal names merge, groups without faces do not count.
  EXPECT_EQ(groups("g a\nf 1 2 3\ng empty\ng b\nf 1 2 3\ng a\nf 3 2 1\n"), (Names{"a", "b"}));
}

TEST(ImportObj, TakesHalfWhereNoMaterialIs) {
  const TemporaryFolder folder;
  const Scene scene = import_scene(folder.write("sample.obj", sample_obj()));  // the library is not there
  for (const Material& material : scene.materials) EXPECT_TRUE((material.reflectance == 0.5).all());
  EXPECT_TRUE(has_note(scene, "'sample.mtl' is missing"));
}

TEST(ImportObj, CutsWhatIsNoPlanarConvexQuad) {
  const TemporaryFolder folder;
  const auto faces = [&](const std::string& text) {
    const Scene scene = import_scene(folder.write("a.obj", text));
    double area = 0;
    for (const Face& face : scene.faces) area += area_vector(scene, face).norm();
    return std::make_pair(scene.faces.size(), area);
  };
  const auto [arrow_count, arrow] = faces("v 0 0 0\nv 2 1 0\nv 0 2 0\nv 1 1 0\nf 1 2 3 4\n");  // not convex
  EXPECT_EQ(arrow_count, 2U);
  EXPECT_NEAR(arrow, 1, 1e-14);
  EXPECT_EQ(faces("v 0 0 0\nv 1 0 0\nv 1 1 0.1\nv 0 1 0\nf 1 2 3 4\n").first, 2U);  // not plane
  const auto [l_count, l] = faces("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5 6\n");
  EXPECT_EQ(l_count, 4U);
  EXPECT_NEAR(l, 3, 1e-14);
}

TEST(ImportPly, ReadsTextAndBytes) {
  const TemporaryFolder folder;
  const Scene text = import_scene(folder.write("a.ply", sample_ascii_ply()));
  ASSERT_EQ(text.faces.size(), 2U);
  EXPECT_EQ(text.faces[0].corner_count, 4);
  EXPECT_TRUE(area_vector(text, text.faces[0]).isApprox(Vector3(0, 0, 1)));
  const Scene binary = import_scene(folder.write("b.ply", sample_binary_ply()));
  ASSERT_EQ(binary.faces.size(), 2U);
  EXPECT_TRUE(area_vector(binary, binary.faces[1]).isApprox(Vector3(0, 0, 0.5)));
  EXPECT_TRUE((binary.materials.front().reflectance == 0.5).all());
}

TEST(ImportStl, ReadsTextAndBytes) {
  const TemporaryFolder folder;
  for (const std::string& content : {sample_ascii_stl(), sample_binary_stl()}) {
    const PatchMesh mesh = make_patches(import_scene(folder.write("a.stl", content)));
    EXPECT_EQ(mesh.patch_count(), 2);
    EXPECT_NEAR(mesh.area.sum(), 1, 1e-7);
    EXPECT_NEAR(mesh.normal.row(2).sum(), 2, 1e-7);
    EXPECT_EQ(mesh.reflectance(0, 0), 0.5);
  }
}

TEST(ImportGltf, AppliesTransformsAndMaterials) {
  const TemporaryFolder folder;
  for (const auto& file : {folder.write("a.gltf", sample_gltf()), folder.write("a.glb", sample_glb())}) {
    const Scene scene = import_scene(file);
    ASSERT_EQ(scene.faces.size(), 2U);
    EXPECT_EQ(corner(scene, scene.faces[0], 0).z(), 5);
    EXPECT_EQ(scene.groups, std::vector<std::string>{"panel"});
    EXPECT_EQ(scene.materials[0].name, "lamp");
    EXPECT_TRUE((scene.materials[0].reflectance == Color(0.25, 0.5, 0.75)).all());
    EXPECT_LT((scene.materials[0].emission - std::numbers::pi * Color(1, 0.5, 0)).abs().maxCoeff(), 1e-6);
  }
}

TEST(OpenScene, SaysWhatIsMissing) {
  const auto message = [](const std::string& name) -> std::string {
    try {
      open_scene(name);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(message("nowhere.obj"), "there is no file 'nowhere.obj'");
  EXPECT_EQ(message("/nowhere/scene"), "there is no file '/nowhere/scene'");
  EXPECT_NE(message("nowhere").find("no built-in scene 'nowhere'"), std::string::npos);
  const TemporaryFolder folder;
  EXPECT_NE(message(folder.write("scene.xyz", "1 2 3").string()).find("no known format"), std::string::npos);
}

}  // namespace
}  // namespace radiosity

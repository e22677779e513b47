#include "foundation/error.hpp"
#include "sample_files.hpp"
#include "scene/import.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <ostream>

namespace radiosity {
namespace {

std::string refusal(const std::filesystem::path& file) {
  try {
    import_scene(file);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

struct Broken {
  const char* file;
  std::string content;
  std::string message;  ///< must occur in the error
};

void PrintTo(const Broken& broken, std::ostream* out) {
  *out << broken.file << ": " << broken.message;
}

class ImportErrors : public testing::TestWithParam<Broken> {};

TEST_P(ImportErrors, NameTheFileAndThePlace) {
  const TemporaryFolder folder;
  const std::string message = refusal(folder.write(GetParam().file, GetParam().content));
  EXPECT_NE(message.find(GetParam().message), std::string::npos) << message;
  EXPECT_NE(message.find(GetParam().file), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

const std::string kVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

INSTANTIATE_TEST_SUITE_P(
    Obj, ImportErrors,
    testing::Values(
        Broken{"a.obj", "", "is empty"},                                       //
        Broken{"a.obj", kVertices, "has no faces"},                            //
        Broken{"a.obj", "# nothing\n", "has no faces"},                        //
        Broken{"a.obj", "v 0 nan 0\n", "a.obj:1: 'nan' is not finite"},        //
        Broken{"a.obj", "\nv 0 0 -inf\n", "a.obj:2: '-inf' is not finite"},    //
        Broken{"a.obj", "v 0 0 1e999\n", "a.obj:1: '1e999' is not a number"},  //
        Broken{"a.obj", "v 0 0 x1\n", "a.obj:1: 'x1' is not a number"},        //
        Broken{"a.obj", "v 0 0 1,5\n", "a.obj:1: '1,5' is not a number"},      //
        Broken{"a.obj", "v 0 0", "a.obj:1: a vertex needs three numbers"},     //
        Broken{"a.obj", kVertices + "f 1 2\n", "a.obj:4: a face needs at least three corners"},
        Broken{"a.obj", kVertices + "f 1 2 3\nf 1 2 4\n", "a.obj:5: vertex 4 does not exist; the file has 3"},
        Broken{"a.obj", kVertices + "f 1 2 0\n", "a.obj:4: '0' is not a corner"},
        Broken{"a.obj", kVertices + "f 1 2 -4\n", "a.obj:4: index -4 reaches back"},
        Broken{"a.obj", kVertices + "f 1 2 3/\n", "a.obj:4: '3/' is not a corner"},
        Broken{"a.obj", kVertices + "f 1 2 3//\n", "a.obj:4: '3//' is not a corner"},
        Broken{"a.obj", kVertices + "f 1 2 3.5\n", "a.obj:4: '3.5' is not a corner"},
        Broken{"a.obj", kVertices + "f 1 2 99999999999\n", "a.obj:4: index 99999999999 is too large"},
        Broken{"a.obj", kVertices + "f 1 2 3/1/1/1\n", "a.obj:4: '3/1/1/1' is not a corner"}));

INSTANTIATE_TEST_SUITE_P(
    Ply, ImportErrors,
    testing::Values(
        Broken{"a.ply", "", "is empty"}, Broken{"a.ply", "ply\nformat ascii 1.0\n", "no complete PLY header"},
        Broken{"a.ply", "plx\nend_header\n", "a.ply:1: a PLY file starts with 'ply'"},
        Broken{"a.ply", "ply\nformat ascii 1.0\nelement vertex many\nend_header\n",
               "a.ply:3: 'many' is not a possible"},
        Broken{"a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\nend_header\n",
               "a.ply:4: 'real' is no PLY type"},
        Broken{
            "a.ply",
            "ply\nformat binary_little_endian 1.0\nelement vertex 2000000000\nproperty float x\nend_header\n",
            "at least 8000000000 bytes are announced"},
        Broken{"a.ply", sample_ascii_ply().substr(0, sample_ascii_ply().size() - 6), "it may be truncated"},
        Broken{"a.ply", sample_binary_ply().substr(0, sample_binary_ply().size() - 3),
               "it may be truncated"}));

INSTANTIATE_TEST_SUITE_P(
    Others, ImportErrors,
    testing::Values(
        Broken{"a.stl", "", "is empty"}, Broken{"a.stl", sample_binary_stl().substr(0, 150), "is truncated"},
        Broken{"a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 nan 0\n",
               "a.stl:4: 'nan' is not finite"},
        Broken{"a.stl", sample_ascii_stl().substr(0, 150), "a.stl:12: a vertex needs three numbers"},
        Broken{"a.glb", "", "is empty"}, Broken{"a.glb", sample_glb().substr(0, 300), "is truncated"},
        Broken{"a.glb", "glTF but not really so", "announced"}, Broken{"a.gltf", "{", "cannot be read"}));

TEST(ImportErrorsPly, NameTheLineInText) {
  const TemporaryFolder folder;
  std::string nan = sample_ascii_ply(), index = nan;
  nan.replace(nan.find("1 1 0\n"), 1, "nan");
  index.replace(index.find("3 0 1 4"), 7, "3 0 1 5");
  EXPECT_NE(refusal(folder.write("a.ply", nan)).find("a.ply:12: vertex 2 is not finite"), std::string::npos)
      << refusal(folder.write("a.ply", nan));
  EXPECT_NE(refusal(folder.write("a.ply", index)).find("a.ply:16: face 1 refers to vertex 5"),
            std::string::npos)
      << refusal(folder.write("a.ply", index));
}

TEST(ImportErrorsMtl, NameTheLibraryAndTheLine) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.obj", sample_obj());
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"newmtl a\nKd 1.5 0 0\n", "sample.mtl:2: Kd 1.5 is above 1"},
      {"newmtl a\n\nKd 0.5 -0.1 0\n", "sample.mtl:3: Kd -0.1 is negative"},
      {"newmtl a\nKe nan 0 0\n", "sample.mtl:2: 'nan' is not finite"},
      {"newmtl a\nKd 0.5 0.5\n", "sample.mtl:2: Kd needs one or three numbers"},
      {"Kd 0.5 0.5 0.5\n", "sample.mtl:1: Kd stands before the first newmtl"},
      {"newmtl a\nKd spectral a.rfl\n", "sample.mtl:2: Kd must be given as RGB"}};
  for (const auto& [library, message] : cases) {
    folder.write("sample.mtl", library);
    EXPECT_NE(refusal(file).find(message), std::string::npos) << refusal(file);
  }
}

}  // namespace
}  // namespace radiosity

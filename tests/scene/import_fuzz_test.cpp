#include "foundation/error.hpp"
#include "foundation/random.hpp"
#include "sample_files.hpp"
#include "scene/import.hpp"
#include "scene/patch_mesh.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>

// The glTF library loses a few bytes when it refuses a damaged buffer; nothing of ours does. Read by the leak
// checker alone.
extern "C" const char*
__lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libassimp";
}  // NOLINT

namespace radiosity {
namespace {

/// One random edit: cut off, overwrite, delete, repeat or swap for a troublesome word.
std::string damaged(std::string text, RandomStream& random) {
  static const std::vector<std::string> words = {
      "nan", "-inf", "1e999", "-1", "0", "4294967295", "99999999999999999999",
      "/",   "\n",   "\r",    "{",  "]", "\"",         std::string(1, '\0')};
  const std::uint64_t edits = 1 + random.below(3);
  for (std::uint64_t edit = 0; edit < edits && !text.empty(); ++edit) {
    const std::size_t at = random.below(text.size());
    const std::size_t length = 1 + random.below(std::min<std::size_t>(12, text.size() - at));
    switch (random.below(5)) {
      case 0:
        text.resize(at);
        break;
      case 1:
        text[at] = static_cast<char>(random.below(256));
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(at, text.substr(at, length));
        break;
      default:
        text.replace(at, length, words[random.below(words.size())]);
    }
  }
  return text;
}

struct Sample {
  const char* file;
  std::string (*content)();
};

class ImportFuzz : public testing::TestWithParam<Sample> {};

// Whatever is done to a file: it imports, or a sentence says why not.
TEST_P(ImportFuzz, DamagedFilesImportOrSayWhyNot) {
  const TemporaryFolder folder;
  folder.write("sample.mtl", sample_mtl());
  const std::string original = GetParam().content();
  ASSERT_NO_THROW(import_scene(folder.write(GetParam().file, original)));
  int imported = 0, refused = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    RandomStream random(20, i);
    const auto file = folder.write(GetParam().file, damaged(original, random));
    try {
      make_patches(import_scene(file));
      ++imported;
    } catch (const Error& error) {
      EXPECT_GT(std::string_view(error.what()).size(), 10U);
      ++refused;
    }
  }
  EXPECT_GT(refused, 40);  // the edits do damage
  EXPECT_GT(imported + refused, 399);
}

INSTANTIATE_TEST_SUITE_P(Formats, ImportFuzz,
                         testing::Values(Sample{"a.obj", sample_obj}, Sample{"b.ply", sample_ascii_ply},
                                         Sample{"c.ply", sample_binary_ply},
                                         Sample{"d.stl", sample_ascii_stl},
                                         Sample{"e.stl", sample_binary_stl}, Sample{"f.gltf", sample_gltf},
                                         Sample{"g.glb", sample_glb}));

TEST(ImportFuzzMaterials, DamagedLibrariesImportOrSayWhyNot) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.obj", sample_obj());
  for (std::uint64_t i = 0; i < 400; ++i) {
    RandomStream random(21, i);
    folder.write("sample.mtl", damaged(sample_mtl(), random));
    try {
      make_patches(import_scene(file));
    } catch (const Error& error) {
      EXPECT_GT(std::string_view(error.what()).size(), 10U);
    }
  }
}

}  // namespace
}  // namespace radiosity

#include "foundation/error.hpp"
#include "gpu/shader_sources.hpp"
#include "tests/gpu/shader_variants.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <string>

namespace radiosity {
namespace {

/// Whether the reference compiler of the language accepts a shader; `name` ends in its stage.
bool is_valid(const std::string& name, const std::string& text, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / name;
  std::ofstream(file) << text;
  return std::system(
             ("glslangValidator '" + file.string() + "' > '" + (folder / "log").string() + "'").c_str()) == 0;
}

std::string log_text(const std::filesystem::path& folder) {
  std::ifstream log(folder / "log");
  return {std::istreambuf_iterator<char>(log), {}};
}

TEST(Shaders, AreValidForTheReferenceCompiler) {
  const TemporaryFolder folder;
  std::set<std::string> used;
  for (const ShaderVariant& variant : shader_variants()) {
    EXPECT_TRUE(is_valid(variant.file, shader_text(variant), folder.path()))
        << variant.file << ": " << log_text(folder.path());
    used.insert(variant.file);
  }
  for (const ShaderFile& file : shader_files())
    if (!file.name.ends_with(".glsl")) {
      EXPECT_TRUE(used.contains(std::string(file.name))) << file.name << " is in no variant";
    }
}

TEST(Shaders, OfWhichOneIsWrongAreRefused) {
  const TemporaryFolder folder;
  EXPECT_FALSE(
      is_valid("broken.comp", "#version 430 core\nvoid main() { not_declared = 1; }\n", folder.path()));
  EXPECT_NE(log_text(folder.path()).find("not_declared"), std::string::npos);
}

TEST(Shaders, ThatDoNotExistAreRefused) {
  EXPECT_THROW(shader_text({"no_such.comp", {}}), UsageError);
}

}  // namespace
}  // namespace radiosity

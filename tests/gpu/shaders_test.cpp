#include "foundation/error.hpp"
#include "gpu/shader_sources.hpp"
#include "tests/gpu/shader_variants.hpp"
#include "tests/temporary_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace radiosity {
namespace {

struct Shader {
  std::string file;  ///< ends in its stage
  std::string text;
};

/// Whether the reference compiler of the language accepts all shaders: one run for all, which is what takes
/// time.
bool are_valid(const std::vector<Shader>& shaders, const std::filesystem::path& folder) {
  std::string command = "glslangValidator";
  for (std::size_t i = 0; i < shaders.size(); ++i) {
    const std::filesystem::path file = folder / fmt::format("{}_{}", i, shaders[i].file);
    std::ofstream(file) << shaders[i].text;
    command += " '" + file.string() + "'";
  }
  return std::system((command + " > '" + (folder / "log").string() + "'").c_str()) == 0;
}

std::string log_text(const std::filesystem::path& folder) {
  std::ifstream log(folder / "log");
  return {std::istreambuf_iterator<char>(log), {}};
}

TEST(Shaders, AreValidForTheReferenceCompiler) {
  const TemporaryFolder folder;
  std::set<std::string> used;
  std::vector<Shader> shaders;
  for (const ShaderVariant& variant : shader_variants()) {
    shaders.push_back({std::string(variant.file), shader_text(variant)});
    used.insert(variant.file);
  }
  EXPECT_TRUE(are_valid(shaders, folder.path())) << log_text(folder.path());
  for (const ShaderFile& file : shader_files())
    if (!file.name.ends_with(".glsl")) {
      EXPECT_TRUE(used.contains(std::string(file.name))) << file.name << " is in no variant";
    }
}

TEST(Shaders, OfWhichOneIsWrongAreRefused) {
  const TemporaryFolder folder;
  const ShaderVariant variant = shader_variants().front();
  const Shader right{std::string(variant.file), shader_text(variant)};
  const Shader wrong{"broken.comp", "#version 430 core\nvoid main() { not_declared = 1; }\n"};
  EXPECT_FALSE(are_valid({right, wrong, right}, folder.path()));
  EXPECT_NE(log_text(folder.path()).find("not_declared"), std::string::npos);
}

TEST(Shaders, ThatDoNotExistAreRefused) {
  EXPECT_THROW(shader_text({"no_such.comp", {}}), UsageError);
}

}  // namespace
}  // namespace radiosity

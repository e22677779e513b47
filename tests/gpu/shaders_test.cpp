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

/// Whether the reference compiler of the language accepts all shaders: one run for all, which is what takes
/// time.
bool are_valid(const std::vector<std::string>& texts, const std::filesystem::path& folder) {
  std::string command = "glslangValidator";
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const std::filesystem::path file = folder / fmt::format("{}.comp", i);
    std::ofstream(file) << texts[i];
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
  std::vector<std::string> texts;
  for (const ShaderVariant& variant : shader_variants()) {
    texts.push_back(shader_text(variant));
    used.insert(variant.file);
  }
  EXPECT_TRUE(are_valid(texts, folder.path())) << log_text(folder.path());
  for (const ShaderFile& file : shader_files())
    if (file.name.ends_with(".comp")) {
      EXPECT_TRUE(used.contains(std::string(file.name))) << file.name << " is in no variant";
    }
}

TEST(Shaders, OfWhichOneIsWrongAreRefused) {
  const TemporaryFolder folder;
  const std::string right = shader_text(shader_variants().front());
  const std::string wrong = "#version 430 core\nvoid main() { not_declared = 1; }\n";
  EXPECT_FALSE(are_valid({right, wrong, right}, folder.path()));
  EXPECT_NE(log_text(folder.path()).find("not_declared"), std::string::npos);
}

TEST(Shaders, ThatDoNotExistAreRefused) {
  EXPECT_THROW(shader_text({"no_such.comp", {}}), UsageError);
}

}  // namespace
}  // namespace radiosity

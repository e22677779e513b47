#include "process.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace radiosity::test {
namespace {

/// The command lines between ```sh and ``` in README.md, without the program's name.
std::vector<std::vector<std::string>> readme_examples() {
  std::ifstream readme(RADIOSITY_SOURCE_DIR "/README.md");
  std::vector<std::vector<std::string>> examples;
  bool inside = false;
  for (std::string line; std::getline(readme, line);) {
    if (line.rfind("```", 0) == 0) inside = line == "```sh";
    if (!inside || line.rfind("radiosity ", 0) != 0) continue;
    std::istringstream words(line.substr(std::string("radiosity ").size()));
    std::vector<std::string>& arguments = examples.emplace_back();
    for (std::string word; words >> word;) arguments.push_back(word);
  }
  return examples;
}

TEST(Readme, EveryExampleWorks) {
  const TemporaryFolder folder;  // one for all: later examples use files of earlier ones
  const auto examples = readme_examples();
  EXPECT_GE(examples.size(), 8u);
  for (const std::vector<std::string>& arguments : examples) {
    const ProcessResult result = run_program(arguments, folder.path());
    if (arguments.front() == "render" && result.errors.find("libgl1-mesa-dri") != std::string::npos)
      continue;  // there is no OpenGL here
    EXPECT_EQ(result.exit_code, 0) << arguments.front() << ": " << result.errors;
    EXPECT_EQ(result.errors, "");
    EXPECT_NE(result.output, "");
  }
}

}  // namespace
}  // namespace radiosity::test

#include "foundation/error.hpp"
#include "foundation/output_file.hpp"

#include <gtest/gtest.h>

#include <iterator>
#include <string>
#include <unistd.h>

namespace radiosity {
namespace {

namespace fs = std::filesystem;

class OutputFileTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string content(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  std::size_t file_count() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_ = fs::temp_directory_path() / ("radiosity-output-file-" + std::to_string(::getpid()));
};

TEST_F(OutputFileTest, AppearsOnlyWhenCommitted) {
  const fs::path target = folder_ / "result.txt";
  OutputFile file(target);
  file.stream() << "whole";
  file.stream().flush();
  EXPECT_FALSE(fs::exists(target));
  file.commit();
  EXPECT_EQ(content(target), "whole");
  EXPECT_EQ(file_count(), 1U);
}

TEST_F(OutputFileTest, LeavesTheOldFileAndNothingElseBehindAnException) {
  const fs::path target = folder_ / "result.txt";
  std::ofstream(target) << "old";
  try {
    OutputFile file(target);
    file.stream() << "half";
    throw Cancelled();
  } catch (const Cancelled&) {
  }
  EXPECT_EQ(content(target), "old");
  EXPECT_EQ(file_count(), 1U);
}

TEST_F(OutputFileTest, KeepsTheExtensionOfTheTarget) {
  const OutputFile file(folder_ / "picture.exr");
  EXPECT_EQ(file.temporary_path().extension(), ".exr");
  EXPECT_EQ(file.temporary_path().parent_path(), folder_);
}

TEST_F(OutputFileTest, RefusesFoldersAndMissingFolders) {
  EXPECT_THROW(OutputFile(folder_ / ""), Error);
  try {
    OutputFile file(folder_ / "missing" / "result.txt");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("result.txt"), std::string::npos) << error.what();
  }
}

TEST_F(OutputFileTest, FoldersAreMadeWithThoseAbove) {
  make_folder(folder_ / "a" / "b");
  make_folder(folder_ / "a" / "b");
  EXPECT_TRUE(fs::is_directory(folder_ / "a" / "b"));
  std::ofstream(folder_ / "file") << "text";
  EXPECT_THROW(make_folder(folder_ / "file" / "c"), Error);
}

}  // namespace
}  // namespace radiosity

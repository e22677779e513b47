#include "apps/frame_files.hpp"

#include "apps/output_check.hpp"
#include "foundation/error.hpp"

#include <fmt/format.h>

#include <utility>

namespace radiosity {
namespace {

constexpr int most_digits = 9;

[[noreturn]] void refuse_pattern(const std::string& pattern) {
  fail<UsageError>(
      "-o {}: write the number of the frame as %d or %04d, once, in a name that ends in .png, as in "
      "frames/%04d.png",
      pattern);
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

FrameFiles::FrameFiles(std::string pattern) : pattern_(std::move(pattern)) {
  if (!wanted()) return;
  begin_ = pattern_.find('%');
  if (begin_ == std::string::npos || pattern_.find('%', begin_ + 1) != std::string::npos)
    refuse_pattern(pattern_);
  std::size_t at = begin_ + 1;
  if (at + 1 < pattern_.size() && pattern_[at] == '0' && is_digit(pattern_[at + 1])) {
    digits_ = pattern_[at + 1] - '0';
    at += 2;
  }
  if (at >= pattern_.size() || pattern_[at] != 'd' || digits_ < 1 || digits_ > most_digits)
    refuse_pattern(pattern_);
  end_ = at + 1;
  if (frame(0).extension() != ".png" || pattern_.find('/', end_) != std::string::npos)
    refuse_pattern(pattern_);
  const std::filesystem::path folder = frame(0).parent_path();
  std::error_code error;
  if (!folder.empty() && !std::filesystem::exists(folder, error)) {
    if (!std::filesystem::create_directory(folder, error))
      fail("cannot make the folder '{}': {}", folder.string(), error.message());
    made_folder_ = folder;
  }
  try {
    require_writable(frame(0));
  } catch (...) {
    if (!made_folder_.empty()) std::filesystem::remove(made_folder_, error);
    throw;
  }
}

FrameFiles::~FrameFiles() {
  std::error_code ignored;  // of folders with files in them
  if (!made_folder_.empty()) std::filesystem::remove(made_folder_, ignored);
}

std::filesystem::path FrameFiles::frame(int number) const {
  return pattern_.substr(0, begin_) + fmt::format("{:0{}}", number, digits_) + pattern_.substr(end_);
}

std::filesystem::path FrameFiles::beside(const std::string& name) const {
  return frame(0).parent_path() / name;
}

}  // namespace radiosity

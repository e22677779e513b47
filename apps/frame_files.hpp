#pragma once

#include <filesystem>
#include <string>

namespace radiosity {

/// The names of a sequence of pictures: a pattern with one %d, or %04d for leading zeros, in place of the
/// number of the frame.
class FrameFiles {
 public:
  /// Empty: no pictures are wanted. Throws UsageError for anything that is no such pattern or does not end in
  /// .png, and Error where it cannot be written there. Makes the last folder of it, and removes that again if
  /// nothing came into it.
  explicit FrameFiles(std::string pattern);
  ~FrameFiles();
  FrameFiles(const FrameFiles&) = delete;
  FrameFiles& operator=(const FrameFiles&) = delete;

  bool wanted() const { return !pattern_.empty(); }
  std::filesystem::path frame(int number) const;
  /// Another file beside them.
  std::filesystem::path beside(const std::string& name) const;

 private:
  std::string pattern_;
  std::size_t begin_ = 0;  ///< of the %d
  std::size_t end_ = 0;
  int digits_ = 1;
  std::filesystem::path made_folder_;
};

}  // namespace radiosity

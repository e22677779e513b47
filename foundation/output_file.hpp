#pragma once

#include <filesystem>
#include <fstream>

namespace radiosity {

/// A file that appears whole or not at all: written to a temporary name beside the target and renamed by
/// commit(). Without commit() (an exception, say) the temporary file is removed.
class OutputFile {
 public:
  /// Throws Error if the folder cannot be written to.
  explicit OutputFile(std::filesystem::path target);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  std::ofstream& stream() { return stream_; }

  /// Where to write instead of stream(), for a library that opens files itself; keeps the target's extension.
  const std::filesystem::path& temporary_path() const { return temporary_; }

  /// Flushes, checks and renames; throws Error if anything could not be written.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  std::ofstream stream_;
  bool committed_ = false;
};

/// Makes a folder and those above it that are missing; throws Error where it cannot be made.
void make_folder(const std::filesystem::path& folder);

}  // namespace radiosity

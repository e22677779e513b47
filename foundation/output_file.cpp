#include "foundation/output_file.hpp"

#include "foundation/error.hpp"

#include <cerrno>
#include <cstring>
#include <system_error>
#include <unistd.h>

namespace radiosity {

namespace fs = std::filesystem;

OutputFile::OutputFile(fs::path target) : target_(std::move(target)) {
  if (target_.filename().empty())
    fail("cannot write '{}': it names a folder; give a file name", target_.string());
  temporary_ = target_.parent_path() /
               fmt::format(".{}.{}{}", target_.stem().string(), ::getpid(), target_.extension().string());
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!stream_)
    fail("cannot write '{}': {}; check the folder and its permissions", target_.string(),
         std::strerror(errno));
}

OutputFile::~OutputFile() {
  if (committed_) return;
  stream_.close();
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void OutputFile::commit() {
  stream_.flush();
  const bool good = stream_.good();
  stream_.close();
  if (!good) fail("cannot write '{}': the disk may be full", target_.string());
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) fail("cannot write '{}': {}", target_.string(), error.message());
  committed_ = true;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail("cannot make the folder '{}': {}", folder.string(), error.message());
}

}  // namespace radiosity

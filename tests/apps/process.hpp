#pragma once

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace radiosity::test {

/// What became of a process.
struct ProcessResult {
  int exit_code = -1;  ///< -1 - signal if a signal ended it
  std::string output;
  std::string errors;
};

/// A folder of its own for a test, removed with all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Writes a file and returns its full path.
  std::string write(const std::string& name, const std::string& content) const;

  /// Names of what is in it, sorted, hidden ones too.
  std::vector<std::string> entries() const;

 private:
  std::filesystem::path path_;
};

/// The radiosity program, started in a folder. Standard output and error go to files outside of that folder.
class RunningProgram {
 public:
  enum class StandardError { file, terminal };

  RunningProgram(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                 StandardError kind = StandardError::file);
  ~RunningProgram();
  /// False where the system has none to give, as in a bare container.
  static bool terminals_exist();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  void send(int signal) const;

  /// Waits until the program handles the signal, a minute at most: until then it would end it as any other.
  bool waits_for(int signal) const;

  /// Waits for the end.
  ProcessResult wait();

 private:
  TemporaryFolder logs_;
  int terminal_ = -1;
  pid_t process_ = -1;
};

/// Runs the program to its end.
ProcessResult run_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

}  // namespace radiosity::test

#include "process.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <pty.h>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace radiosity::test {

namespace fs = std::filesystem;

namespace {

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

/// In the child: becomes the program.
[[noreturn]] void become(const std::vector<std::string>& arguments, const fs::path& folder,
                         const fs::path& output, int error_descriptor) {
  std::vector<char*> words = {const_cast<char*>(RADIOSITY_PROGRAM)};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  const int output_descriptor = open(output.c_str(), O_WRONLY | O_CREAT, 0600);
  dup2(output_descriptor, STDOUT_FILENO);
  dup2(error_descriptor, STDERR_FILENO);
  if (chdir(folder.c_str()) == 0) execv(RADIOSITY_PROGRAM, words.data());
  _exit(127);
}

std::string read_terminal(int terminal) {
  std::string text;
  std::array<char, 4096> buffer{};
  for (ssize_t count = 1; count > 0;) {  // fails once the other side is closed
    count = read(terminal, buffer.data(), buffer.size());
    if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
  }
  return text;
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "radiosity-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string TemporaryFolder::write(const std::string& name, const std::string& content) const {
  const fs::path file = path_ / name;
  std::ofstream(file, std::ios::binary) << content;
  return file.string();
}

std::vector<std::string> TemporaryFolder::entries() const {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

RunningProgram::RunningProgram(const std::vector<std::string>& arguments, const fs::path& folder,
                               StandardError kind) {
  int error_descriptor = -1;
  if (kind == StandardError::terminal) {
    if (openpty(&terminal_, &error_descriptor, nullptr, nullptr, nullptr) != 0)
      throw std::runtime_error("cannot open a terminal");
  } else {
    error_descriptor = open((logs_.path() / "errors").c_str(), O_WRONLY | O_CREAT, 0600);
  }
  process_ = fork();
  if (process_ == 0) become(arguments, folder, logs_.path() / "output", error_descriptor);
  close(error_descriptor);
  if (process_ < 0) throw std::runtime_error("cannot start a process");
}

bool RunningProgram::terminals_exist() {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  if (terminal < 0) return false;
  const bool usable = grantpt(terminal) == 0 && unlockpt(terminal) == 0 && ptsname(terminal) != nullptr;
  close(terminal);
  return usable;
}

RunningProgram::~RunningProgram() {
  if (process_ > 0) {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  if (terminal_ >= 0) close(terminal_);
}

void RunningProgram::send(int signal) const {
  kill(process_, signal);
}

bool RunningProgram::waits_for(int signal) const {
  using namespace std::chrono_literals;
  const auto deadline = std::chrono::steady_clock::now() + 60s;
  const fs::path status = fs::path("/proc") / std::to_string(process_) / "status";
  const std::string key = "SigCgt:";
  while (std::chrono::steady_clock::now() < deadline) {
    const std::string text = content_of(status);
    const std::size_t at = text.find(key);
    if (at == std::string::npos) return false;
    const std::uint64_t caught = std::stoull(text.substr(at + key.size()), nullptr, 16);
    if ((caught >> static_cast<unsigned>(signal - 1) & 1U) != 0) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

ProcessResult RunningProgram::wait() {
  ProcessResult result;
  if (terminal_ >= 0) result.errors = read_terminal(terminal_);
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = -1;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1 - WTERMSIG(status);
  result.output = content_of(logs_.path() / "output");
  if (terminal_ < 0) result.errors = content_of(logs_.path() / "errors");
  return result;
}

ProcessResult run_program(const std::vector<std::string>& arguments, const fs::path& folder) {
  return RunningProgram(arguments, folder).wait();
}

}  // namespace radiosity::test

#include "process.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

namespace radiosity::test {
namespace {

using namespace std::chrono_literals;

/// Work that would take minutes, and would then write two files.
const std::vector<std::string> long_work = {"form-factors", "cornell-box", "--patches", "30000",
                                            "--save",       "k",           "-o",        "F.npy"};

ProcessResult interrupted(int signal, const TemporaryFolder& folder) {
  RunningProgram program(long_work, folder.path());
  EXPECT_TRUE(program.waits_for(signal));
  std::this_thread::sleep_for(500ms);  // into the work
  program.send(signal);
  return program.wait();
}

TEST(Interruption, CtrlCEndsInOrder) {
  const TemporaryFolder folder;
  const auto start = std::chrono::steady_clock::now();
  const ProcessResult result = interrupted(SIGINT, folder);
  EXPECT_LT(std::chrono::steady_clock::now() - start, 30s);
  EXPECT_EQ(result.exit_code, 128 + SIGINT);
  EXPECT_EQ(result.errors, "radiosity: stopped on request\n");
  EXPECT_EQ(result.output, "");
  EXPECT_TRUE(folder.entries().empty());
}

TEST(Interruption, SoDoesTermination) {
  const TemporaryFolder folder;
  EXPECT_EQ(interrupted(SIGTERM, folder).exit_code, 128 + SIGTERM);
  EXPECT_TRUE(folder.entries().empty());
}

const std::vector<std::string> short_work = {"form-factors", "cornell-box", "--patches", "3000"};

constexpr const char* no_terminal = "the system gives no terminal: /dev/pts is not mounted";

TEST(Progress, IsDrawnOnATerminal) {
  if (!RunningProgram::terminals_exist()) GTEST_SKIP() << no_terminal;
  const TemporaryFolder folder;
  RunningProgram program(short_work, folder.path(), RunningProgram::StandardError::terminal);
  const ProcessResult result = program.wait();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.errors.find('%'), std::string::npos);
  EXPECT_NE(result.errors.find('\r'), std::string::npos);
}

TEST(Progress, IsNotDrawnInAPipe) {
  const TemporaryFolder folder;
  const ProcessResult result = run_program(short_work, folder.path());
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.errors, "");
}

TEST(Progress, IsNotDrawnWhenQuiet) {
  if (!RunningProgram::terminals_exist()) GTEST_SKIP() << no_terminal;
  const TemporaryFolder folder;
  std::vector<std::string> work = short_work;
  work.push_back("--quiet");
  RunningProgram program(work, folder.path(), RunningProgram::StandardError::terminal);
  EXPECT_EQ(program.wait().errors, "");
}

}  // namespace
}  // namespace radiosity::test

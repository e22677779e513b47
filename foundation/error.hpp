#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace radiosity {

/// Something the user can understand and act on: what was wrong, where, and what to do, in one sentence.
/// The program prints it as it is and exits with 1.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A wrong option, spec string or argument: the program exits with 2.
class UsageError : public Error {
 public:
  using Error::Error;
};

/// The user asked to stop (Ctrl-C). Nothing half-written may be left behind by whoever lets it pass.
class Cancelled : public Error {
 public:
  Cancelled() : Error("stopped on request") {}
};

/// Throws an Error (or the given kind of it) with a formatted sentence.
template <typename Kind = Error, typename... Args>
[[noreturn]] void fail(fmt::format_string<Args...> text, Args&&... args) {
  throw Kind(fmt::format(text, std::forward<Args>(args)...));
}

}  // namespace radiosity

#include "apps/terminal_monitor.hpp"

#include "apps/interruption.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <unistd.h>

namespace radiosity {
namespace {

constexpr int bar_width = 30;
constexpr auto first_drawing_after = std::chrono::milliseconds(300);  // short work shows nothing
constexpr auto redrawing_after = std::chrono::milliseconds(100);

}  // namespace

TerminalMonitor::TerminalMonitor(bool quiet)
    : visible_(!quiet && isatty(STDERR_FILENO) == 1), next_drawing_(Clock::now() + first_drawing_after) {}

TerminalMonitor::~TerminalMonitor() {
  clear();
}

void TerminalMonitor::report(std::string_view stage, double fraction) {
  if (!visible_) return;
  const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
  if (!lock || Clock::now() < next_drawing_) return;  // somebody else draws, or it is too early
  next_drawing_ = Clock::now() + redrawing_after;
  const double done = std::clamp(fraction, 0.0, 1.0);
  const int filled = static_cast<int>(done * bar_width);
  fmt::print(stderr, "\r\x1b[K{} [{:#<{}}{:.<{}}] {:3.0f} %", stage, "", filled, "", bar_width - filled,
             100 * done);
  std::fflush(stderr);
  drawn_ = true;
}

bool TerminalMonitor::cancelled() const {
  return received_signal() != 0;
}

void TerminalMonitor::clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!drawn_) return;
  fmt::print(stderr, "\r\x1b[K");
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace radiosity

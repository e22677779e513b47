#include "apps/terminal_monitor.hpp"

#include "apps/interruption.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <unistd.h>

namespace radiosity {
namespace {

constexpr int bar_width = 30;
constexpr auto first_drawing_after = std::chrono::milliseconds(300);  // short work shows nothing
constexpr auto redrawing_after = std::chrono::milliseconds(100);
constexpr auto line_after = std::chrono::seconds(20);

}  // namespace

TerminalMonitor::TerminalMonitor(bool quiet)
    : visible_(!quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      next_showing_(start_ +
                    (terminal_ ? Clock::duration(first_drawing_after) : Clock::duration(line_after))) {}

TerminalMonitor::~TerminalMonitor() {
  clear();
}

void TerminalMonitor::report(std::string_view stage, double fraction) {
  if (!visible_) return;
  const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
  if (!lock || Clock::now() < next_showing_) return;  // somebody else shows it, or it is too early
  if (terminal_)
    draw(stage, std::clamp(fraction, 0.0, 1.0));
  else
    write_line(stage, std::clamp(fraction, 0.0, 1.0));
  next_showing_ = Clock::now() + (terminal_ ? Clock::duration(redrawing_after) : Clock::duration(line_after));
}

void TerminalMonitor::draw(std::string_view stage, double fraction) {
  const int filled = static_cast<int>(fraction * bar_width);
  fmt::print(stderr, "\r\x1b[K{} [{:#<{}}{:.<{}}] {:3.0f} %", stage, "", filled, "", bar_width - filled,
             100 * fraction);
  std::fflush(stderr);
  drawn_ = true;
}

void TerminalMonitor::write_line(std::string_view stage, double fraction) const {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(Clock::now() - start_).count();
  const std::string done = fraction > 0 ? fmt::format(", {:.0f} %", 100 * fraction) : "";
  fmt::print(stderr, "after {} s: {}{}\n", seconds, stage, done);
  std::fflush(stderr);
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

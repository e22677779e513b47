#pragma once

#include "foundation/monitor.hpp"

#include <chrono>
#include <mutex>
#include <string_view>

namespace radiosity {

/// Draws one line of progress on standard error, and is cancelled by Ctrl-C (interruption.hpp). Draws nothing
/// where standard error is no terminal, nor when asked to be quiet.
class TerminalMonitor final : public Monitor {
 public:
  explicit TerminalMonitor(bool quiet);
  ~TerminalMonitor() override;
  TerminalMonitor(const TerminalMonitor&) = delete;
  TerminalMonitor& operator=(const TerminalMonitor&) = delete;

  void report(std::string_view stage, double fraction) override;
  bool cancelled() const override;

  /// Removes the line, so that something else can be printed.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool visible_;
  bool drawn_ = false;
  Clock::time_point next_drawing_;
  std::mutex mutex_;
};

}  // namespace radiosity

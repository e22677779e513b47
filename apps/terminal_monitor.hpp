#pragma once

#include "foundation/monitor.hpp"

#include <chrono>
#include <mutex>
#include <string_view>

namespace radiosity {

/// Draws one line of progress on standard error, or, where that is no terminal, writes a line of it now and
/// then when work takes long. Is cancelled by Ctrl-C (interruption.hpp). Shows nothing when asked to be
/// quiet.
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

  void draw(std::string_view stage, double fraction);
  void write_line(std::string_view stage, double fraction) const;

  bool visible_;
  bool terminal_;
  bool drawn_ = false;
  Clock::time_point start_;
  Clock::time_point next_showing_;
  std::mutex mutex_;
};

}  // namespace radiosity

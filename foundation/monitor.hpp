#pragma once

#include "foundation/error.hpp"

#include <string_view>

namespace radiosity {

/// How long work reports to whoever started it, and is told to stop. The default does neither; the program
/// passes one that draws a bar on a terminal and watches for Ctrl-C. Called from several threads at once.
class Monitor {
 public:
  virtual ~Monitor() = default;

  /// A piece of work called `stage` is `fraction` done, 0 <= fraction <= 1.
  virtual void report(std::string_view stage, double fraction) = 0;

  /// True once the work should end.
  virtual bool cancelled() const = 0;

  /// Reports, then throws Cancelled if the work should end.
  void checkpoint(std::string_view stage, double fraction) {
    report(stage, fraction);
    if (cancelled()) throw Cancelled();
  }
};

/// Reports nothing and never cancels.
class SilentMonitor final : public Monitor {
 public:
  void report(std::string_view, double) override {}
  bool cancelled() const override { return false; }
};

}  // namespace radiosity

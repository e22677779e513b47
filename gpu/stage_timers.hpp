#pragma once

#include "foundation/stopwatch.hpp"
#include "gpu/gl_name.hpp"

#include <deque>
#include <memory>
#include <vector>

namespace radiosity {

/// Times of the stages of frames, of which several are under way: timer queries at the borders of stages,
/// read once the device is past them. Software renderers give no time to compute shaders in queries
/// (GlTimer): there each stage ends when all that was asked for is done. The context is current in every
/// call.
class StageTimers {
 public:
  enum class Clock { device, finishing };
  static Clock preferred(const GlContext& context) {
    return context.software() ? Clock::finishing : Clock::device;
  }

  /// For `frames` frames at a time.
  StageTimers(std::shared_ptr<const GlContext> context, int stages, int frames)
      : StageTimers(context, stages, frames, preferred(*context)) {}
  StageTimers(std::shared_ptr<const GlContext> context, int stages, int frames, Clock clock);

  void begin(int frame);
  /// Stages end one after the other, each begins where the one before ended.
  void end_stage(int frame, int stage);
  /// Of each stage of that frame, which the device has finished (a fence says so).
  const std::vector<double>& seconds(int frame);

 private:
  unsigned query(int frame, int border) const;

  std::shared_ptr<const GlContext> context_;
  int stages_;
  Clock clock_;
  Stopwatch watch_;
  std::deque<GlName> queries_;           ///< stages + 1 a frame, of the device's clock
  std::vector<std::vector<double>> at_;  ///< the borders of stages, by frame
  std::vector<double> seconds_;
};

}  // namespace radiosity

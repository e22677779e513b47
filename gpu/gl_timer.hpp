#pragma once

#include "foundation/stopwatch.hpp"
#include "gpu/gl_context.hpp"

#include <memory>

namespace radiosity {

/// Time that the device spends on what is asked of it while a Measurement lives, one at a time. Software
/// renderers run compute shaders at once and give them no time in timer queries (Mesa's llvmpipe): there it
/// is the time that the calls take. The context is current in every call but the destructor's.
class GlTimer {
 public:
  explicit GlTimer(std::shared_ptr<const GlContext> context);
  ~GlTimer();
  GlTimer(const GlTimer&) = delete;
  GlTimer& operator=(const GlTimer&) = delete;

  class Measurement {
   public:
    explicit Measurement(GlTimer& timer);
    ~Measurement();
    Measurement(const Measurement&) = delete;
    Measurement& operator=(const Measurement&) = delete;

   private:
    GlTimer& timer_;
    Stopwatch watch_;
  };

  /// Of the last one. Waits for the device; free where its results were read back before.
  double seconds() const;

 private:
  std::shared_ptr<const GlContext> context_;
  unsigned name_ = 0;
  double wall_seconds_ = 0;  ///< of the last one on a software renderer
};

}  // namespace radiosity

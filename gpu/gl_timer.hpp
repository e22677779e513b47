#pragma once

#include "gpu/gl_context.hpp"

#include <memory>

namespace radiosity {

/// Time that the device spends on what is asked of it between begin() and end(). The context is current in
/// every call but the destructor's.
class GlTimer {
 public:
  explicit GlTimer(std::shared_ptr<const GlContext> context);
  ~GlTimer();
  GlTimer(const GlTimer&) = delete;
  GlTimer& operator=(const GlTimer&) = delete;

  void begin();
  void end();
  /// Waits for the device; free where its results were read back before.
  double seconds() const;

 private:
  std::shared_ptr<const GlContext> context_;
  unsigned name_ = 0;
};

}  // namespace radiosity

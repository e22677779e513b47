#include "gpu/gl_timer.hpp"

#include <epoxy/gl.h>
#include <utility>

namespace radiosity {

GlTimer::GlTimer(std::shared_ptr<const GlContext> context) : context_(std::move(context)) {
  glGenQueries(1, &name_);
}

GlTimer::~GlTimer() {
  context_->when_current([this] { glDeleteQueries(1, &name_); });
}

GlTimer::Measurement::Measurement(GlTimer& timer) : timer_(timer) {
  if (!timer_.context_->software()) glBeginQuery(GL_TIME_ELAPSED, timer_.name_);
}

GlTimer::Measurement::~Measurement() {
  if (timer_.context_->software()) {
    glFinish();
    timer_.wall_seconds_ = watch_.seconds();
  } else {
    glEndQuery(GL_TIME_ELAPSED);
  }
}

double GlTimer::seconds() const {
  if (context_->software()) return wall_seconds_;
  GLuint64 nanoseconds = 0;
  glGetQueryObjectui64v(name_, GL_QUERY_RESULT, &nanoseconds);
  return 1e-9 * static_cast<double>(nanoseconds);
}

}  // namespace radiosity

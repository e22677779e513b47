#include "gpu/stage_timers.hpp"

#include <epoxy/gl.h>
#include <utility>

namespace radiosity {

StageTimers::StageTimers(std::shared_ptr<const GlContext> context, int stages, int frames, Clock clock)
    : context_(std::move(context)),
      stages_(stages),
      clock_(clock),
      seconds_(static_cast<std::size_t>(stages), 0) {
  const auto borders = static_cast<std::size_t>(stages) + 1;
  at_.assign(static_cast<std::size_t>(frames), std::vector<double>(borders, 0));
  if (clock_ == Clock::finishing) return;
  for (std::size_t k = 0; k < borders * static_cast<std::size_t>(frames); ++k)
    queries_.emplace_back(context_, glGenQueries, glDeleteQueries);
}

unsigned StageTimers::query(int frame, int border) const {
  return queries_[static_cast<std::size_t>(frame * (stages_ + 1) + border)].get();
}

void StageTimers::begin(int frame) {
  end_stage(frame, -1);
}

void StageTimers::end_stage(int frame, int stage) {
  if (clock_ == Clock::device) return glQueryCounter(query(frame, stage + 1), GL_TIMESTAMP);
  glFinish();
  at_[static_cast<std::size_t>(frame)][static_cast<std::size_t>(stage + 1)] = watch_.seconds();
}

const std::vector<double>& StageTimers::seconds(int frame) {
  std::vector<double>& at = at_[static_cast<std::size_t>(frame)];
  if (clock_ == Clock::device)
    for (int border = 0; border <= stages_; ++border) {
      GLuint64 nanoseconds = 0;
      glGetQueryObjectui64v(query(frame, border), GL_QUERY_RESULT, &nanoseconds);
      at[static_cast<std::size_t>(border)] = 1e-9 * static_cast<double>(nanoseconds);
    }
  for (std::size_t stage = 0; stage < seconds_.size(); ++stage) seconds_[stage] = at[stage + 1] - at[stage];
  return seconds_;
}

}  // namespace radiosity

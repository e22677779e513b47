#include "foundation/parallel.hpp"

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <optional>

namespace radiosity {

struct ThreadLimit::Implementation {
  std::optional<tbb::global_control> control;
};

ThreadLimit::ThreadLimit(int count) : implementation_(std::make_unique<Implementation>()) {
  if (count > 0)
    implementation_->control.emplace(tbb::global_control::max_allowed_parallelism,
                                     static_cast<std::size_t>(count));
}

ThreadLimit::~ThreadLimit() = default;

int ThreadLimit::current() {
  const auto allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return static_cast<int>(allowed);
}

}  // namespace radiosity

#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>
#include <memory>

namespace radiosity {

/// Calls body(i) for 0 <= i < count, in parallel and in any order. Each body writes only what belongs to its
/// i, so that results do not depend on the number of threads. An exception from a body ends the loop and is
/// rethrown.
template <typename Body>
void parallel_for(std::size_t count, const Body& body, std::size_t grain = 1) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
                    });
}

/// Limits parallel_for to `count` threads while it lives; 0 leaves the machine's own number.
class ThreadLimit {
 public:
  explicit ThreadLimit(int count);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

  /// The number of threads in force now.
  static int current();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace radiosity

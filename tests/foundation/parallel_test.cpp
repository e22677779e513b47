#include "foundation/error.hpp"
#include "foundation/parallel.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace radiosity {
namespace {

TEST(ParallelFor, VisitsEachNumberOnce) {
  for (const int threads : {1, 2, 8}) {
    const ThreadLimit limit(threads);
    std::vector<int> visits(10007, 0);
    parallel_for(visits.size(), [&](std::size_t i) { ++visits[i]; });
    EXPECT_EQ(visits, std::vector<int>(10007, 1)) << threads << " threads";
  }
}

TEST(ParallelFor, DoesNothingForNoWork) {
  parallel_for(0, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, PassesExceptionsOn) {
  EXPECT_THROW(parallel_for(1000,
                            [](std::size_t i) {
                              if (i == 777) fail("item {} cannot be done", i);
                            }),
               Error);
}

TEST(ThreadLimit, HoldsWhileItLives) {
  const int before = ThreadLimit::current();
  {
    const ThreadLimit limit(1);
    EXPECT_EQ(ThreadLimit::current(), 1);
  }
  EXPECT_EQ(ThreadLimit::current(), before);
  const ThreadLimit none(0);
  EXPECT_EQ(ThreadLimit::current(), before);
}

}  // namespace
}  // namespace radiosity

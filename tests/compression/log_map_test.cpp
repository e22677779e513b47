#include "compression/log_map.hpp"
#include "foundation/error.hpp"
#include "foundation/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace radiosity {
namespace {

TEST(LogMap, HasTheDocumentsCodes) {
  const LogMap map(0.2);
  EXPECT_EQ(map.range(), 25);
  EXPECT_EQ(map.code(0.2), 255);
  EXPECT_NEAR(map.code(0.2 * std::exp(-5)), 204, 1e-10);
  EXPECT_NEAR(map.code(0.2 * std::exp(-24)), 10.2, 1e-10);
  EXPECT_EQ(map.code(0.2 * std::exp(-26)), 0);
  EXPECT_EQ(map.code(0.3), 255);
  EXPECT_EQ(map.value(255), 0.2);
  EXPECT_NEAR(map.value(204), 0.2 * std::exp(-5), 1e-15);
}

TEST(LogMap, ZeroIsZeroBothWays) {
  for (const double largest : {0.0, 5e-324, 1.0, 1e300}) {
    const LogMap map(largest, 7);
    EXPECT_EQ(map.code(0), 0);
    EXPECT_EQ(map.value(0), 0);
  }
  EXPECT_EQ(LogMap(0).value(255), 0);
  EXPECT_EQ(LogMap(0).code(0), 0);
}

TEST(LogMap, WholeCodesMeetValuesWithinHalfAStep) {
  for (const double range : {3.0, 7.0, 25.0})
    for (const double largest : {1e-300, 0.1, 1e200}) {
      const LogMap map(largest, range);
      RandomStream random(4);
      for (int trial = 0; trial < 200; ++trial) {
        const double value = largest * std::exp(-random.uniform(0, 0.997 * range));
        EXPECT_NEAR(map.value(map.code(value)) / value, 1, 1e-12);
        const double whole = map.value(std::round(map.code(value)));
        EXPECT_LE(std::abs(std::log(whole / value)), range / 510 * (1 + 1e-9));
      }
    }
  // The check can fail: codes of another range.
  EXPECT_GT(std::abs(std::log(LogMap(1, 25).value(LogMap(1, 24).code(0.01)) / 0.01)), 24.0 / 510);
}

TEST(LogMap, SubnormalValuesHaveCodes) {
  const LogMap map(1e-320);
  EXPECT_EQ(map.code(1e-320), 255);
  EXPECT_GT(map.code(5e-324), 0);
  EXPECT_LT(map.code(5e-324), 255);
  EXPECT_EQ(LogMap(1).code(5e-324), 0);
}

TEST(LogMap, RefusesImpossibleParameters) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  for (const double largest : {-1.0, nan, infinity}) EXPECT_THROW(LogMap(largest, 25), UsageError) << largest;
  for (const double range : {0.0, -1.0, nan, infinity}) EXPECT_THROW(LogMap(1.0, range), UsageError) << range;
}

TEST(LogSums, RangeLeavesOutAtMostTheShare) {
  RandomStream random(8);
  std::vector<double> values(5000);
  for (double& value : values) value = 3 * std::exp(-random.uniform(0, 12));
  std::sort(values.begin(), values.end());
  LogSums sums(values.back());
  for (const double value : values) sums.add(value);
  const double total = std::accumulate(values.begin(), values.end(), 0.0);
  for (const double share : {0.0, 1e-5, 1e-3, 0.1}) {
    const double range = sums.range(share);
    const auto sum_below = [&](double limit) {
      double sum = 0;
      for (const double value : values) sum += value < values.back() * std::exp(-limit) ? value : 0;
      return sum;
    };
    EXPECT_LE(sum_below(range), share * total * (1 + 1e-12));
    EXPECT_GT(sum_below(range - 1.0 / 16 - 1e-12), share * total * (1 - 1e-12)) << "no shorter one would do";
  }
}

TEST(LogSums, AreJoinedFromParts) {
  LogSums all(1), first(1), second(1);
  for (int k = 0; k < 100; ++k) {
    const double value = std::exp(-0.11 * k);
    all.add(value);
    (k % 2 == 0 ? first : second).add(value);
  }
  first.add(second);
  for (const double share : {0.0, 1e-4, 1e-2}) EXPECT_EQ(first.range(share), all.range(share));
  EXPECT_THROW(first.add(LogSums(2)), UsageError);
}

TEST(LogSums, HaveARangeForEveryMatrix) {
  EXPECT_EQ(LogSums(0).range(0), 1.0 / 16);
  LogSums constant(0.25);
  constant.add(0.25);
  constant.add(0);
  EXPECT_EQ(constant.range(1e-6), 1.0 / 16);
  LogSums widest(1e308);
  widest.add(5e-324);
  widest.add(1e308);
  EXPECT_GT(widest.range(0), 1400);
  EXPECT_EQ(widest.range(1e-9), 1.0 / 16);
}

TEST(LogSums, RefuseWhatCannotBeSummed) {
  LogSums sums(1);
  EXPECT_THROW(sums.add(-1e-9), Error);
  EXPECT_THROW(sums.add(1.5), Error);
  EXPECT_THROW(sums.add(std::nan("")), Error);
  EXPECT_THROW(sums.range(1), UsageError);
  EXPECT_THROW(sums.range(-0.1), UsageError);
  EXPECT_THROW(LogSums(-1.0), UsageError);
}

}  // namespace
}  // namespace radiosity

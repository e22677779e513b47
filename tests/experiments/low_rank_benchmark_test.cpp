#include "experiments/low_rank_benchmark.hpp"
#include "foundation/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace radiosity {
namespace {

LowRankBenchmarkOptions small_low_rank_options() {
  LowRankBenchmarkOptions options;
  options.sizes = {{200, 24}, {65, 65}};
  options.threads = {1, 2};
  options.seconds = 1e-3;
  options.stream_bytes = std::size_t{1} << 20;
  return options;
}

TEST(LowRankBenchmark, TimesProductsSumsAndTheLibraryForEachSizeAndNumberOfThreads) {
  const auto results = benchmark_low_rank(small_low_rank_options());
  ASSERT_EQ(results.size(), 4u);
  EXPECT_EQ(results[0].threads, 1);
  EXPECT_EQ(results[2].size.rows, 65);
  for (const LowRankBenchmark& result : results) {
    EXPECT_GE(result.repetitions, 1);
    EXPECT_GT(result.read_bandwidth_gb_s, 0);
    EXPECT_GT(result.sums_speedup, 0);
    EXPECT_GT(result.sparse_speedup, 0);
    for (const char* name : {"U C", "V' X"})
      for (const Index columns : {1, 3})
        EXPECT_EQ(std::count_if(result.rows.begin(), result.rows.end(),
                                [&](const auto& row) { return row.name == name && row.columns == columns; }),
                  1)
            << name;
    for (const LowRankBenchmarkRow& row : result.rows) {
      EXPECT_GT(row.bytes, 0u) << row.name;
      EXPECT_GT(row.seconds_min, 0) << row.name;
      EXPECT_GE(row.seconds_median, row.seconds_min) << row.name;
      EXPECT_GT(row.bandwidth_fraction, 0) << row.name;
    }
  }
}

TEST(LowRankBenchmark, PrintsOneLineAProduct) {
  LowRankBenchmarkOptions options = small_low_rank_options();
  options.columns = {3};
  const auto results = benchmark_low_rank(options);
  std::ostringstream out;
  print_low_rank_benchmark(results, out);
  const std::string text = out.str();
  std::size_t lines = 0;
  for (const LowRankBenchmark& result : results) lines += 3 + result.rows.size();
  EXPECT_EQ(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')), lines);
  EXPECT_NE(text.find("OpenBLAS V' X"), std::string::npos);
}

TEST(LowRankBenchmark, ReadsSizes) {
  const LowRankSize size = LowRankSize::parse("221184x216");
  EXPECT_EQ(size.rows, 221184);
  EXPECT_EQ(size.rank, 216);
  for (const char* wrong : {"", "12", "12x", "x3", "12x3x", "-12x3", "12x-3", "0x1", "12 x 3", "1e3x4"})
    EXPECT_THROW(LowRankSize::parse(wrong), UsageError) << wrong;
}

TEST(LowRankBenchmark, RefusesWhatMakesNoSense) {
  const auto refused = [](LowRankSize size, Index columns, double seconds) {
    LowRankBenchmarkOptions options = small_low_rank_options();
    options.sizes = {size};
    options.columns = {columns};
    options.seconds = seconds;
    EXPECT_THROW(benchmark_low_rank(options), UsageError);
  };
  refused({10, 0}, 1, 1e-3);
  refused({10, 11}, 1, 1e-3);
  refused({10, 2}, 0, 1e-3);
  refused({10, 2}, 1, 0);
  LowRankBenchmarkOptions options = small_low_rank_options();
  options.sizes = {{1 << 30, 1 << 20}};  // 13 PB
  EXPECT_THROW(benchmark_low_rank(options), Error);
}

}  // namespace
}  // namespace radiosity

#include "experiments/apply_benchmark.hpp"
#include "foundation/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace radiosity {
namespace {

ApplyBenchmarkOptions small_options() {
  ApplyBenchmarkOptions options;
  options.size = 200;
  options.threads = {1, 2};
  options.seconds = 1e-3;
  options.stream_bytes = std::size_t{1} << 20;
  return options;
}

TEST(ApplyBenchmark, TimesEveryOperatorAndTheLibrariesForEachNumberOfThreads) {
  const auto results = benchmark_apply(cpu_operators(), small_options());
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[0].threads, 1);
  for (const ApplyBenchmark& result : results) {
    EXPECT_EQ(result.size, 200);
    EXPECT_GE(result.repetitions, 1);
    EXPECT_GT(result.read_bandwidth_gb_s, 0);
    for (const Index columns : {1, 3})
      for (const char* name : {"dense:f64", "dense:f32", "dense:f16", "csr:f64", "Eigen float"})
        EXPECT_EQ(std::count_if(result.rows.begin(), result.rows.end(),
                                [&](const auto& row) { return row.name == name && row.columns == columns; }),
                  1)
            << name;
    for (const ApplyBenchmarkRow& row : result.rows) {
      EXPECT_GT(row.bytes, 0u) << row.name;
      EXPECT_GT(row.seconds_min, 0) << row.name;
      EXPECT_GE(row.seconds_median, row.seconds_min) << row.name;
      EXPECT_GT(row.bandwidth_fraction, 0) << row.name;
      EXPECT_GT(row.sgemv_ratio, 0) << row.name;
      if (row.name == "OpenBLAS sgemv") {
        EXPECT_EQ(row.sgemv_ratio, 1);
      }
    }
  }
}

TEST(ApplyBenchmark, PrintsOneLineAProduct) {
  ApplyBenchmarkOptions options = small_options();
  options.operators = {"dense:f32"};
  options.columns = {3};
  const auto results = benchmark_apply(cpu_operators(), options);
  std::ostringstream out;
  print_apply_benchmark(results, out);
  const std::string text = out.str();
  std::size_t lines = 0;
  for (const ApplyBenchmark& result : results) lines += 2 + result.rows.size();
  EXPECT_EQ(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')), lines);
  EXPECT_NE(text.find("OpenBLAS sgemv"), std::string::npos);
}

TEST(ApplyBenchmark, RefusesWhatMakesNoSense) {
  ApplyBenchmarkOptions options = small_options();
  options.size = 0;
  EXPECT_THROW(benchmark_apply(cpu_operators(), options), UsageError);
  options = small_options();
  options.seconds = 0;
  EXPECT_THROW(benchmark_apply(cpu_operators(), options), UsageError);
  options = small_options();
  options.columns = {0};
  EXPECT_THROW(benchmark_apply(cpu_operators(), options), UsageError);
  options = small_options();
  options.operators = {"dens"};
  EXPECT_THROW(benchmark_apply(cpu_operators(), options), UsageError);
  options = small_options();
  options.size = 1 << 20;  // 35 TB
  EXPECT_THROW(benchmark_apply(cpu_operators(), options), Error);
}

}  // namespace
}  // namespace radiosity

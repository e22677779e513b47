#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace radiosity {

using Index = Eigen::Index;

/// n x k of a low-rank operator's factors.
struct LowRankSize {
  Index rows = 0;
  Index rank = 0;

  /// From "221184x216". Throws UsageError for anything else.
  static LowRankSize parse(std::string_view text);
};

struct LowRankBenchmarkOptions {
  std::vector<LowRankSize> sizes = {{221184, 216}, {55296, 864}};
  std::vector<Index> columns = {1, 3};  ///< columns multiplied at once; 1 is always among them
  std::vector<int> threads = {1, 0};    ///< measured one after the other; 0: all that are allowed
  double seconds = 10;                  ///< for each size and number of threads
  std::size_t stream_bytes = std::size_t{1}
                             << 30;  ///< buffer of the read bandwidth: more than the last cache holds
};

struct LowRankBenchmarkRow {
  std::string name;
  Index columns = 1;
  std::size_t bytes = 0;  ///< of the stored matrices, or of the field and the indices that sums read
  double seconds_min = 0;
  double seconds_median = 0;
  double bandwidth_fraction =
      0;  ///< bytes / seconds_min / read bandwidth measured in between; above 1 where caches help
};

struct LowRankBenchmark {
  LowRankSize size;
  int threads = 0;
  int repetitions = 0;
  double load_before = 0;  ///< the system's load average of the last minute: above 0 means company
  double load_after = 0;
  double read_bandwidth_gb_s = 0;  ///< best of streaming sums, 1e9 bytes a second
  std::vector<LowRankBenchmarkRow> rows;
  double sums_speedup = 0;    ///< V' E with full V over segment sums of a sorted field: seconds, one column
  double sparse_speedup = 0;  ///< E + Y (V' E) with full V over sparse V (document 004, Eq. 5), one column
};

/// Times the products of low-rank operators T = U V' with random float factors of n x k, V full and sparse
/// (one number a row, document 004, Eq. 7), against the memory's read bandwidth and OpenBLAS. Repetitions of
/// all competitors take turns, so that noise hits all alike. Throws UsageError for sizes, columns and times
/// that are not positive and Error where the factors do not fit into free memory.
std::vector<LowRankBenchmark> benchmark_low_rank(const LowRankBenchmarkOptions& options = {});

/// Tables for a terminal.
void print_low_rank_benchmark(const std::vector<LowRankBenchmark>& results, std::ostream& out);

}  // namespace radiosity

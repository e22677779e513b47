#pragma once

#include "operators/operator_registry.hpp"

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

struct ApplyBenchmarkOptions {
  Index size = 16384;                   ///< n of the synthetic kernel, in which every entry is present
  std::vector<Index> columns = {1, 3};  ///< columns multiplied at once
  std::vector<std::string>
      operators;  ///< specs; empty: the defaults and variants of every registered one that is not cubic
  std::vector<int> threads = {1, 0};  ///< measured one after the other; 0: all that are allowed
  double seconds = 10;                ///< for each number of threads
  std::size_t stream_bytes = std::size_t{1}
                             << 30;  ///< buffer of the read bandwidth: more than the last cache holds
};

/// One competitor: an operator, or a library's product with the full n x n matrix.
struct ApplyBenchmarkRow {
  std::string name;
  Index columns = 1;
  std::size_t bytes = 0;  ///< of the matrix, each of which an apply reads once
  double seconds_min = 0;
  double seconds_median = 0;
  double bandwidth_fraction =
      0;  ///< bytes / seconds_min / read bandwidth measured in between; above 1 where caches help
  double sgemv_ratio = 0;  ///< columns a second over those of OpenBLAS's sgemv
};

struct ApplyBenchmark {
  Index size = 0;
  int threads = 0;
  int repetitions = 0;
  double load_before = 0;  ///< the system's load average of the last minute: above 0 means company
  double load_after = 0;
  std::optional<DeviceUse> device;  ///< of the operators; empty: the CPU
  double read_bandwidth_gb_s = 0;   ///< best of streaming sums, 1e9 bytes a second
  std::vector<ApplyBenchmarkRow> rows;
};

/// Times the apply of every operator against the memory's read bandwidth, OpenBLAS (sgemv, dgemv; sgemm for
/// several columns) and Eigen. Repetitions of all competitors take turns, so that noise hits all alike.
/// Throws UsageError for sizes, columns and times that are not positive and Error where the matrices do not
/// fit into free memory.
std::vector<ApplyBenchmark> benchmark_apply(const OperatorRegistry& registry,
                                            const ApplyBenchmarkOptions& options = {});

/// A table for a terminal.
void print_apply_benchmark(const std::vector<ApplyBenchmark>& results, std::ostream& out);

}  // namespace radiosity

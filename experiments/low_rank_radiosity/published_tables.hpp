#pragma once

#include "experiments/low_rank_benchmark.hpp"

#include <optional>
#include <span>

namespace radiosity {

/// A row of document 004's Tables 1 and 2: ratios of the times of two implementations.
struct PublishedRatios {
  LowRankSize size;
  double full_to_sparse_cpu = 0;
  double full_to_sparse_gpu = 0;
  double sparse_cpu_to_sparse_gpu = 0;
  double full_cpu_to_sparse_gpu = 0;
};

/// A row of its Table 3: frames a second on its first machine (Pentium E5200, GeForce 9800 GTX+).
struct PublishedSpeeds {
  LowRankSize size;
  double full_cpu = 0;
  double sparse_cpu = 0;
  double full_gpu = 0;
  double sparse_gpu = 0;
};

/// A row of its Tables 4 and 5: frames a second with sparse V on its second machine (Xeon E5530, Tesla
/// c1060), and, in Table 4, over those of the first.
struct PublishedSecondMachine {
  LowRankSize size;
  double cpu = 0;
  double gpu = 0;
  std::optional<double> cpu_speedup;
  std::optional<double> gpu_speedup;
};

std::span<const PublishedRatios> published_table_1();  ///< V' E
std::span<const PublishedRatios> published_table_2();  ///< B
std::span<const PublishedSpeeds> published_table_3();
const PublishedSpeeds& published_average();  ///< the last line of Table 3, without a size
std::span<const PublishedSecondMachine> published_table_4();
std::span<const PublishedSecondMachine> published_table_5();

/// The row of a size; null if the table has none.
template <typename Row>
const Row* published_row(std::span<const Row> table, const LowRankSize& size) {
  for (const Row& row : table)
    if (row.size.rows == size.rows && row.size.rank == size.rank) return &row;
  return nullptr;
}

}  // namespace radiosity

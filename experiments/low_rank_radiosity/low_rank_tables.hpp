#pragma once

#include "experiments/comparison.hpp"
#include "experiments/device/device_results.hpp"
#include "experiments/low_rank_benchmark.hpp"
#include "experiments/report.hpp"
#include "foundation/monitor.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// Tables 1 to 5 of document 004 on the cube, with its n and k.
struct LowRankTablesOptions {
  std::vector<LowRankSize> sizes;        ///< of Tables 1 to 3, at least one; the last three are Table 4's
  std::vector<LowRankSize> large_sizes;  ///< of Table 5: sparse V only
  double largest_timed = 5e7;            ///< n k above which a size keeps its line but is not measured
  double largest_computed = 1.2e7;  ///< n k above which Y is random: as fast, but no illumination of anything
  double largest_dense_error = 3456;                ///< n up to which B is compared with the dense solution
  LightCounts lights = {.area = 12};                ///< of the errors
  double seconds = 1;                               ///< of timing for each size that caches hold
  double streamed_seconds = 3;                      ///< for each that is read from memory
  std::size_t stream_bytes = std::size_t{1} << 30;  ///< read to measure the memory's bandwidth
  std::size_t cached_bytes = 100'000'000;           ///< of Y, below which bandwidth is not asked for
  double tolerance = 1e-3;                          ///< of each F_ep
  std::uint64_t seed = 1;
  std::shared_ptr<const DeviceResults> device;  ///< for the columns of graphics processors; null: none

  /// The document's nine sizes and six large ones.
  LowRankTablesOptions();
};

/// One frame of Algorithm 2 and its first product, c columns at once.
struct FrameTimes {
  int threads = 0;
  Index columns = 1;
  std::optional<Timing>
      full_sums;       ///< X = V' E with all n k numbers of V; empty where only sparse V is timed
  Timing sparse_sums;  ///< the same from E sorted by patch
  std::optional<Timing> full_frame;  ///< B = E - Y X, with X
  Timing sparse_frame;
  std::optional<double> full_bandwidth;  ///< bytes of Y and V / time / read bandwidth; empty in the cache
  std::optional<double> sparse_bandwidth;
};

/// Relative errors in B of uniform 2MSC over the lights, against the dense solution with the F of all
/// elements.
struct DenseErrors {
  double radiosity_mean = 0;      ///< of ||B - B_dense||_A / ||B_dense||_A
  double indirect_mean = 0;       ///< the same for B - E
  double largest_difference = 0;  ///< of |B - B_dense| / B_dense over elements and lights
};

/// One n x k.
struct LowRankTableRow {
  LowRankSize size;
  std::size_t sparse_bytes = 0;       ///< of Y and V as offsets
  std::size_t full_bytes = 0;         ///< of Y and V
  bool computed = false;              ///< Y from form factors; else random
  double factor_seconds = 0;          ///< to compute U
  double fold_seconds = 0;            ///< to make Y of U
  std::vector<FrameTimes> times;      ///< empty: not measured
  std::optional<DenseErrors> errors;  ///< empty where Y is random or n too large

  /// Empty where it was not measured.
  const FrameTimes* find(int threads, Index columns) const;
};

struct LowRankTables {
  int threads = 0;  ///< of "all threads"
  double load_before = 0;
  double load_after = 0;
  double resident_bytes = 0;  ///< the most that the process had in memory so far
  std::vector<LowRankTableRow> rows;
  std::vector<LowRankTableRow> large_rows;
};

/// Throws Error where a size that is to be measured does not fit into free memory.
LowRankTables measure_low_rank_tables(const LowRankTablesOptions& options, Monitor& monitor);

/// The tables, the document's numbers beside ours.
ReportSection low_rank_tables_section(const LowRankTables& tables, const LowRankTablesOptions& options,
                                      const std::string& command);

/// low_rank_tables.json and low_rank_tables.csv; `device`: null or what the JSON names as "device".
void write_low_rank_tables(const std::filesystem::path& folder, const LowRankTables& tables,
                           const DeviceResults* device = nullptr);

/// Measures, writes low_rank_tables.json and .csv into `folder` (made if it is missing), returns the section.
ReportSection low_rank_tables(const std::filesystem::path& folder, const std::string& command,
                              const LowRankTablesOptions& options, Monitor& monitor);

}  // namespace radiosity

#include "experiments/low_rank_radiosity/low_rank_tables.hpp"

#include "experiments/low_rank_radiosity/cube_meshes.hpp"
#include "experiments/low_rank_radiosity/dense_solutions.hpp"
#include "experiments/low_rank_radiosity/frame_times.hpp"
#include "experiments/low_rank_radiosity/precomputed_woodbury.hpp"
#include "experiments/low_rank_radiosity/published_tables.hpp"
#include "experiments/low_rank_radiosity/solved_factors.hpp"
#include "foundation/error.hpp"
#include "foundation/memory.hpp"
#include "foundation/output_file.hpp"
#include "foundation/parallel.hpp"
#include "foundation/stopwatch.hpp"
#include "operators/direct_two_mesh.hpp"
#include "scene/coarse_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sys/resource.h>
#include <utility>

namespace radiosity {
namespace {

double entries_of(const LowRankSize& size) {
  return static_cast<double>(size.rows) * static_cast<double>(size.rank);
}

SolvedFactors compute_factors(const LowRankTablesOptions& options, LowRankTableRow& row, Monitor& monitor) {
  const Stopwatch factor_watch;
  const PatchMesh elements = cube_mesh(row.size.rows);
  const CoarseMesh coarse = assign_elements(elements, cube_mesh(row.size.rank), Assignment::inclusion);
  DirectTwoMeshFactors factors = compute_two_mesh_factors(
      elements, coarse, {.tolerance = options.tolerance, .seed = options.seed}, monitor);
  row.factor_seconds = factor_watch.seconds();
  const Stopwatch fold_watch;
  Eigen::VectorXd reflectance = elements.reflectance.col(0);
  if (!factors.V.order().empty()) reflectance = Eigen::VectorXd(reflectance(factors.V.order()));
  TallMatrix<float> Y = precompute_woodbury(factors.V, std::move(factors.U), reflectance, monitor);
  row.fold_seconds = fold_watch.seconds();
  row.computed = true;
  return {std::move(factors.V), std::move(Y)};
}

/// Y, V in full, meshes and a batch of rows in double.
void require_room_for_row(const LowRankSize& size, bool with_full) {
  require_available_memory(fmt::format("document 004's {} x {}", size.rows, size.rank),
                           entries_of(size) * sizeof(float) * (with_full ? 2 : 1) * 1.3,
                           "free some, or leave --full away");
}

LowRankTableRow measure_table_row(const LowRankSize& size, bool with_full,
                                  const LowRankTablesOptions& options, ReadStream& stream,
                                  DenseSolutions& dense, Monitor& monitor) {
  LowRankTableRow row;
  row.size = size;
  if (entries_of(size) > options.largest_timed) return row;
  monitor.checkpoint(fmt::format("{} x {}", size.rows, size.rank), 0);
  require_room_for_row(size, with_full);
  const SolvedFactors factors = entries_of(size) <= options.largest_computed
                                    ? compute_factors(options, row, monitor)
                                    : random_factors(size, options.seed);
  if (row.computed) row.errors = dense.compare(factors.V, factors.Y, monitor);
  row.sparse_bytes = factors.Y.entry_bytes() + factors.V.offset_bytes();
  std::optional<TallMatrix<float>> full;
  if (with_full) full.emplace(full_matrix(factors.V));
  if (full) row.full_bytes = factors.Y.entry_bytes() + full->entry_bytes();
  monitor.checkpoint(fmt::format("timing {} x {}", size.rows, size.rank), 0);
  const bool streamed = factors.Y.entry_bytes() >= options.cached_bytes;
  row.times = time_frames(factors.Y, factors.V, full ? &*full : nullptr, streamed ? &stream : nullptr,
                          streamed ? options.streamed_seconds : options.seconds);
  return row;
}

double most_resident_bytes() {
  constexpr double kilobyte = 1024;
  rusage usage{};
  return getrusage(RUSAGE_SELF, &usage) == 0 ? kilobyte * static_cast<double>(usage.ru_maxrss) : 0;
}

}  // namespace

LowRankTablesOptions::LowRankTablesOptions() {
  sizes.reserve(published_table_3().size());
  for (const PublishedSpeeds& row : published_table_3()) sizes.push_back(row.size);
  large_sizes.reserve(published_table_5().size());
  for (const PublishedSecondMachine& row : published_table_5()) large_sizes.push_back(row.size);
}

const FrameTimes* LowRankTableRow::find(int threads, Index columns) const {
  for (const FrameTimes& frame : times)
    if (frame.threads == threads && frame.columns == columns) return &frame;
  return nullptr;
}

LowRankTables measure_low_rank_tables(const LowRankTablesOptions& options, Monitor& monitor) {
  if (options.sizes.empty()) fail<UsageError>("the tables of document 004 need one size n x k at least");
  LowRankTables tables;
  tables.threads = ThreadLimit::current();
  tables.load_before = load_average();
  ReadStream stream(options.stream_bytes);
  DenseSolutions dense(options);
  for (const LowRankSize& size : options.sizes)
    tables.rows.push_back(measure_table_row(size, true, options, stream, dense, monitor));
  for (const LowRankSize& size : options.large_sizes)
    tables.large_rows.push_back(measure_table_row(size, false, options, stream, dense, monitor));
  tables.load_after = load_average();
  tables.resident_bytes = most_resident_bytes();
  return tables;
}

ReportSection low_rank_tables(const std::filesystem::path& folder, const std::string& command,
                              const LowRankTablesOptions& options, Monitor& monitor) {
  make_folder(folder);
  const LowRankTables tables = measure_low_rank_tables(options, monitor);
  write_low_rank_tables(folder, tables, options.device.get());
  return low_rank_tables_section(tables, options, command);
}

}  // namespace radiosity

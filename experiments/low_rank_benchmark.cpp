#include "experiments/low_rank_benchmark.hpp"

#include "experiments/machine.hpp"
#include "experiments/read_stream.hpp"
#include "experiments/taking_turns.hpp"
#include "factorizations/blas_threads.hpp"
#include "foundation/error.hpp"
#include "foundation/memory.hpp"
#include "foundation/parallel.hpp"
#include "foundation/random.hpp"
#include "kernels/segment_sums.hpp"

#include <cblas.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <ostream>

namespace radiosity {
namespace {

constexpr std::uint64_t benchmark_seed = 4;

TallMatrix<float> random_factor(const LowRankSize& size, std::uint64_t stream) {
  TallMatrix<float> factor(size.rows, size.rank);
  parallel_for(static_cast<std::size_t>(factor.panels()), [&](std::size_t index) {
    const auto b = static_cast<Index>(index);
    RandomStream random(benchmark_seed + stream, index);
    Eigen::MatrixXd entries(std::min<Index>(64, size.rows - 64 * b), size.rank);
    for (double& entry : entries.reshaped()) entry = random.uniform();
    factor.fill_panel(b, entries);
  });
  return factor;
}

Eigen::MatrixXd random_field(Index rows, Index columns) {
  RandomStream random(benchmark_seed);
  Eigen::MatrixXd field(rows, columns);
  for (double& number : field.reshaped()) number = random.uniform();
  return field;
}

/// Runs of about n / k rows, and runs of rows of the scene that are split between them, as the elements of a
/// wall are among the patches that lie side by side on it.
Segments scene_segments(const LowRankSize& size) {
  constexpr Index row_of_elements = 8;
  std::vector<std::int32_t> segment(static_cast<std::size_t>(size.rows));
  const Index wall = std::max<Index>(size.rows / size.rank, 1) * row_of_elements;
  for (Index e = 0; e < size.rows; ++e) {
    const Index patch = e / wall * row_of_elements + e / row_of_elements % row_of_elements;
    segment[static_cast<std::size_t>(e)] = static_cast<std::int32_t>(std::min(patch, size.rank - 1));
  }
  return sort_by_segment(segment, size.rank);
}

const Competitor& find(const std::vector<Competitor>& competitors, std::string_view name) {
  return *std::find_if(competitors.begin(), competitors.end(),
                       [&](const Competitor& competitor) { return competitor.name == name; });
}

/// The factors of one size and everything that multiplies with them.
class LowRankContest {
 public:
  LowRankContest(const LowRankSize& size, const LowRankBenchmarkOptions& options, ReadStream& stream)
      : size_(size),
        U_(random_factor(size, 1)),
        V_(random_factor(size, 2)),
        segments_(scene_segments(size)),
        single_(Eigen::MatrixXf::Constant(size.rows, size.rank, 0.5F)) {
    competitors_.push_back(
        {"read", 0, stream.quarter_bytes(), [&stream] { stream.read_quarter(); }, ReadStream::quarters});
    for (const Index columns : options.columns) add_products(columns);
    add_solutions();
    add_sums();
    add_library();
  }

  LowRankBenchmark run(double seconds) {
    LowRankBenchmark result;
    result.size = size_;
    result.threads = ThreadLimit::current();
    const BlasThreads blas_threads(result.threads);
    result.load_before = load_average();
    result.repetitions = take_turns(competitors_, seconds);
    result.load_after = load_average();
    result.read_bandwidth_gb_s = find(competitors_, "read").gigabytes_per_second();
    for (const Competitor& competitor : competitors_)
      if (competitor.name != "read")
        result.rows.push_back({competitor.name, competitor.columns, competitor.bytes,
                               competitor.seconds_min(), competitor.seconds_median(),
                               competitor.gigabytes_per_second() / result.read_bandwidth_gb_s});
    result.sums_speedup =
        find(competitors_, "V' X").seconds_min() / find(competitors_, "sums, sorted").seconds_min();
    result.sparse_speedup =
        find(competitors_, "full V").seconds_min() / find(competitors_, "sparse V").seconds_min();
    return result;
  }

 private:
  struct Fields {
    Eigen::MatrixXd X, C, Y, sums;
  };

  std::shared_ptr<Fields> fields(Index columns) const {
    return std::make_shared<Fields>(
        Fields{random_field(size_.rows, columns), random_field(size_.rank, columns),
               Eigen::MatrixXd::Zero(size_.rows, columns), Eigen::MatrixXd::Zero(size_.rank, columns)});
  }

  void add(std::string name, Index columns, std::size_t bytes, std::function<void()> work) {
    competitors_.push_back({std::move(name), columns, bytes, std::move(work)});
  }

  void add_products(Index columns) {
    const auto f = fields(columns);
    add("U C", columns, U_.entry_bytes(), [this, f] { multiply(U_, f->C, f->Y); });
    add("V' X", columns, V_.entry_bytes(), [this, f] { multiply_transposed(V_, f->X, f->sums); });
  }

  /// B = E + U (V' E): Eq. 5 with U in the place of -Y.
  void add_solutions() {
    const auto f = fields(1);
    add("full V", 1, U_.entry_bytes() + V_.entry_bytes(), [this, f] {
      multiply_transposed(V_, f->X, f->sums);
      multiply(U_, f->sums, f->Y);
      f->Y += f->X;
    });
    add("sparse V", 1, U_.entry_bytes() + segments_.offset_bytes(), [this, f] {
      segment_sums(segments_, f->X, f->sums, RowOrder::sorted);
      multiply(U_, f->sums, f->Y);
      f->Y += f->X;
    });
  }

  /// With a field each, which no other competitor has left in a cache.
  void add_sums() {
    const std::size_t bytes =
        segments_.offset_bytes() + static_cast<std::size_t>(size_.rows) * sizeof(double);
    add("sums, sorted", 1, bytes,
        [this, f = fields(1)] { segment_sums(segments_, f->X, f->sums, RowOrder::sorted); });
    add("sums, scene", 1, bytes + segments_.order_bytes(),
        [this, f = fields(1)] { segment_sums(segments_, f->X, f->sums, RowOrder::scene); });
  }

  void add_library() {
    const auto x = std::make_shared<Eigen::VectorXf>(Eigen::VectorXf::Ones(size_.rows));
    const auto c = std::make_shared<Eigen::VectorXf>(Eigen::VectorXf::Ones(size_.rank));
    const auto n = static_cast<int>(size_.rows);
    const auto k = static_cast<int>(size_.rank);
    const std::size_t bytes = static_cast<std::size_t>(single_.size()) * sizeof(float);
    add("OpenBLAS U C", 1, bytes, [=, this] {
      cblas_sgemv(CblasColMajor, CblasNoTrans, n, k, 1, single_.data(), n, c->data(), 1, 0, x->data(), 1);
    });
    add("OpenBLAS V' X", 1, bytes, [=, this] {
      cblas_sgemv(CblasColMajor, CblasTrans, n, k, 1, single_.data(), n, x->data(), 1, 0, c->data(), 1);
    });
  }

  LowRankSize size_;
  TallMatrix<float> U_;
  TallMatrix<float> V_;
  Segments segments_;
  Eigen::MatrixXf single_;
  std::vector<Competitor> competitors_;
};

void check_low_rank_options(const LowRankBenchmarkOptions& options) {
  if (!(options.seconds > 0))
    fail<UsageError>("a benchmark of {} s: give it a positive time", options.seconds);
  for (const Index columns : options.columns)
    if (columns < 1) fail<UsageError>("a benchmark with {} columns: choose at least 1", columns);
  for (const LowRankSize& size : options.sizes) {
    if (size.rank < 1 || size.rows < size.rank || size.rows > std::numeric_limits<int>::max())
      fail<UsageError>("a benchmark of {} x {}: choose 1 <= k <= n < 2^31", size.rows, size.rank);
    const double factors =
        3.0 * sizeof(float) * static_cast<double>(size.rows) * static_cast<double>(size.rank);
    require_available_memory(fmt::format("a benchmark of {} x {}", size.rows, size.rank),
                             factors + static_cast<double>(options.stream_bytes), "choose a smaller size");
  }
}

}  // namespace

LowRankSize LowRankSize::parse(std::string_view text) {
  LowRankSize size;
  const char* end = text.data() + text.size();
  const auto rows = std::from_chars(text.data(), end, size.rows);
  if (rows.ec == std::errc() && rows.ptr != end && *rows.ptr == 'x') {
    const auto rank = std::from_chars(rows.ptr + 1, end, size.rank);
    if (rank.ec == std::errc() && rank.ptr == end && size.rows > 0 && size.rank > 0) return size;
  }
  fail<UsageError>("'{}' is no size n x k: write it as 221184x216", text);
}

std::vector<LowRankBenchmark> benchmark_low_rank(const LowRankBenchmarkOptions& options) {
  check_low_rank_options(options);
  LowRankBenchmarkOptions wanted = options;
  // The ratios of full to sparse V are of one column.
  if (std::find(wanted.columns.begin(), wanted.columns.end(), 1) == wanted.columns.end())
    wanted.columns.push_back(1);
  std::sort(wanted.columns.begin(), wanted.columns.end());
  ReadStream stream(wanted.stream_bytes);
  std::vector<LowRankBenchmark> results;
  for (const LowRankSize& size : wanted.sizes) {
    LowRankContest contest(size, wanted, stream);
    for (const int threads : wanted.threads) {
      const ThreadLimit limit(threads);
      results.push_back(contest.run(wanted.seconds));
    }
  }
  return results;
}

void print_low_rank_benchmark(const std::vector<LowRankBenchmark>& results, std::ostream& out) {
  for (const LowRankBenchmark& result : results) {
    fmt::print(out,
               "n x k = {} x {}, {} thread{}, {} repetitions, load {:.1f} to {:.1f}, read bandwidth {:.1f} "
               "GB/s\n",
               result.size.rows, result.size.rank, result.threads, result.threads == 1 ? "" : "s",
               result.repetitions, result.load_before, result.load_after, result.read_bandwidth_gb_s);
    fmt::print(out, "  {:<16} {:>7} {:>9} {:>9} {:>9} {:>14}\n", "product", "columns", "MB", "min ms",
               "median ms", "of bandwidth");
    for (const LowRankBenchmarkRow& row : result.rows)
      fmt::print(out, "  {:<16} {:>7} {:>9.2f} {:>9.3f} {:>9.3f} {:>14.2f}\n", row.name, row.columns,
                 1e-6 * static_cast<double>(row.bytes), 1e3 * row.seconds_min, 1e3 * row.seconds_median,
                 row.bandwidth_fraction);
    fmt::print(out, "  full V over sparse V: {:.1f} x for V' E, {:.2f} x for B\n", result.sums_speedup,
               result.sparse_speedup);
  }
}

}  // namespace radiosity

#include "kernels/sparse_powers.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>

namespace radiosity {
namespace {

constexpr double single_roundoff = 0x1p-24;

/// A power whose row is this much longer than that of the first never comes down again.
constexpr double endless_growth = 1e12;

constexpr std::size_t bytes_per_entry = sizeof(float) + sizeof(std::int32_t);

/// W M W^-1 without its small entries.
CsrMatrix<double> weighed(const CsrMatrix<double>& M, const Eigen::VectorXd& weights, double threshold) {
  CsrMatrix<double> result;
  result.cols = M.cols;
  result.row_begin.reserve(M.row_begin.size());
  for (Index i = 0; i < M.rows(); ++i) {
    for (auto k = static_cast<std::size_t>(M.row_begin[static_cast<std::size_t>(i)]);
         k < static_cast<std::size_t>(M.row_begin[static_cast<std::size_t>(i) + 1]); ++k) {
      const double entry = weights[i] * M.value[k] / weights[M.column[k]];
      if (entry == 0 || !(std::fabs(entry) >= threshold)) continue;
      result.column.push_back(M.column[k]);
      result.value.push_back(entry);
    }
    result.row_begin.push_back(static_cast<std::int64_t>(result.column.size()));
  }
  return result;
}

/// So many rows of a power are multiplied together, so that an entry of the matrix is read once for all.
constexpr Index rows_together = 8;

/// One number a row.
struct alignas(64) Lanes {
  std::array<double, rows_together> value{};

  double& operator[](std::size_t lane) { return value[lane]; }
  double operator[](std::size_t lane) const { return value[lane]; }

  void add_product(const Lanes& factor, double entry) {
    for (std::size_t lane = 0; lane < rows_together; ++lane) value[lane] += factor.value[lane] * entry;
  }
};

/// The series of `rows_together` rows after another. A row's series does not depend on the rows beside it.
class RowSeries {
 public:
  RowSeries(const CsrMatrix<double>& first, const SparsePowersOptions& options)
      : first_(first),
        options_(options),
        sum_(static_cast<std::size_t>(first.cols)),
        product_(static_cast<std::size_t>(first.cols)) {}

  /// Sums rows i ... i + count - 1, at most `rows_together`; what was there before is forgotten.
  void run(Index i, Index count) {
    std::fill(sum_.begin(), sum_.end(), Lanes{});
    powers_ = {};
    remainder_ = {};
    running_ = {};
    for (Index row = i; row < i + count; ++row) start(row, static_cast<std::size_t>(row - i));
    take_product();
    const Lanes first_norms = norms(power_);
    Lanes before = first_norms;
    for (int powers = 1; !column_.empty(); ++powers) {
      for (std::size_t k = 0; k < column_.size(); ++k)
        sum_[static_cast<std::size_t>(column_[k])].add_product(power_[k], 1);
      const Lanes now = norms(power_);
      const Lanes sums = norms(sum_);
      for (std::size_t lane = 0; lane < rows_together; ++lane)
        if (running_[lane]) judge(lane, powers, {first_norms[lane], before[lane], now[lane], sums[lane]});
      before = now;
      if (powers == options_.most_powers) return;
      multiply_power();
      take_product();
    }
    for (std::size_t lane = 0; lane < rows_together; ++lane)
      if (running_[lane]) remainder_[lane] = 0;
  }

  double sum(std::size_t lane, std::size_t column) const { return sum_[column][lane]; }
  int powers(std::size_t lane) const { return powers_[lane]; }
  double remainder(std::size_t lane) const { return remainder_[lane]; }

 private:
  void start(Index row, std::size_t lane) {
    running_[lane] = true;
    const auto end = static_cast<std::size_t>(first_.row_begin[static_cast<std::size_t>(row) + 1]);
    for (auto k = static_cast<std::size_t>(first_.row_begin[static_cast<std::size_t>(row)]); k < end; ++k)
      product_[static_cast<std::size_t>(first_.column[k])][lane] = first_.value[k];
  }

  static Lanes norms(const std::vector<Lanes>& rows) {
    Lanes result;
    for (const Lanes& entries : rows)
      for (std::size_t lane = 0; lane < rows_together; ++lane) result[lane] += entries[lane] * entries[lane];
    for (double& square : result.value) square = std::sqrt(square);
    return result;
  }

  struct RowNorms {
    double first;
    double before;
    double now;
    double sum;
  };

  /// Whether a row goes on after its power number `powers`: further ones are estimated as a geometric series
  /// of the last two norms.
  void judge(std::size_t lane, int powers, const RowNorms& norm) {
    if (norm.now == 0) {  // what was left has been dropped
      running_[lane] = false;
      remainder_[lane] = 0;
      return;
    }
    powers_[lane] = powers;
    if (norm.now > endless_growth * norm.first)
      fail("the powers of a matrix grow without end: its spectral radius is above 1");
    if (powers == 1) return;
    const double ratio = norm.now / norm.before;
    remainder_[lane] = ratio < 1 ? norm.now * ratio / (1 - ratio) / norm.sum : norm.now / norm.sum;
    running_[lane] = !(ratio < 1 && remainder_[lane] <= single_roundoff);
  }

  /// The next power of the rows.
  void multiply_power() {
    for (std::size_t k = 0; k < column_.size(); ++k) {
      const Lanes factor = power_[k];
      const auto row = static_cast<std::size_t>(column_[k]);
      const auto end = static_cast<std::size_t>(first_.row_begin[row + 1]);
      for (auto entry = static_cast<std::size_t>(first_.row_begin[row]); entry < end; ++entry)
        product_[static_cast<std::size_t>(first_.column[entry])].add_product(factor, first_.value[entry]);
    }
  }

  /// Makes the product the power, without its small entries and the rows that have ended.
  void take_product() {
    column_.clear();
    power_.clear();
    for (std::size_t j = 0; j < product_.size(); ++j) {
      Lanes entries = std::exchange(product_[j], Lanes{});
      bool any = false;
      for (std::size_t lane = 0; lane < rows_together; ++lane) {
        if (!running_[lane] || !(std::fabs(entries[lane]) >= options_.threshold)) entries[lane] = 0;
        any = any || entries[lane] != 0;
      }
      if (!any) continue;
      column_.push_back(static_cast<std::int32_t>(j));
      power_.push_back(entries);
    }
  }

  const CsrMatrix<double>& first_;
  const SparsePowersOptions& options_;
  std::vector<Lanes> sum_;
  std::vector<Lanes> product_;        ///< 0 between products
  std::vector<std::int32_t> column_;  ///< where any row of the power is not 0
  std::vector<Lanes> power_;          ///< there
  std::array<int, rows_together> powers_{};
  std::array<double, rows_together> remainder_{};
  std::array<bool, rows_together> running_{};
};

/// Consecutive rows of the sum, in M's own entries.
struct Rows {
  std::vector<std::int64_t> counts;
  std::vector<std::int32_t> column;
  std::vector<float> value;
  int powers = 0;
  double remainder = 0;

  void append(const RowSeries& series, std::size_t lane, Index i, const Eigen::VectorXd& weights) {
    const std::size_t before = column.size();
    for (std::size_t j = 0; j < static_cast<std::size_t>(weights.size()); ++j) {
      const auto entry =
          static_cast<float>(series.sum(lane, j) * weights[static_cast<Index>(j)] / weights[i]);
      if (entry == 0) continue;
      column.push_back(static_cast<std::int32_t>(j));
      value.push_back(entry);
    }
    counts.push_back(static_cast<std::int64_t>(column.size() - before));
    powers = std::max(powers, series.powers(lane));
    remainder = std::max(remainder, series.remainder(lane));
  }
};

SparsePowers join(std::vector<Rows> blocks, Index cols) {
  SparsePowers result;
  result.sum.cols = cols;
  for (Rows& block : blocks) {
    for (const std::int64_t count : block.counts)
      result.sum.row_begin.push_back(result.sum.row_begin.back() + count);
    result.sum.column.insert(result.sum.column.end(), block.column.begin(), block.column.end());
    result.sum.value.insert(result.sum.value.end(), block.value.begin(), block.value.end());
    result.powers = std::max(result.powers, block.powers);
    result.remainder = std::max(result.remainder, block.remainder);
    block = {};  // so that the sum is not in memory twice
  }
  return result;
}

}  // namespace

SparsePowers sum_sparse_powers(const CsrMatrix<double>& M, const Eigen::VectorXd& weights,
                               const SparsePowersOptions& options) {
  const Index n = M.rows();
  if (M.cols != n || weights.size() != n)
    fail<UsageError>(
        "the powers of a matrix of {} x {} with {} weights: give a square matrix and a weight a row", n,
        M.cols, weights.size());
  const CsrMatrix<double> first = weighed(M, weights, options.threshold);
  std::vector<Rows> blocks(static_cast<std::size_t>((n + rows_together - 1) / rows_together));
  std::atomic<std::size_t> entries = 0;
  parallel_for(blocks.size(), [&](std::size_t block) {
    RowSeries series(first, options);
    const Index first_row = static_cast<Index>(block) * rows_together;
    const Index rows = std::min(rows_together, n - first_row);
    series.run(first_row, rows);
    for (Index row = 0; row < rows; ++row)
      blocks[block].append(series, static_cast<std::size_t>(row), first_row + row, weights);
    const std::size_t found = blocks[block].value.size();
    if (bytes_per_entry * (entries += found) > options.most_bytes)
      fail(
          "the sum of the powers of a matrix of {} x {} takes more than {:.3g} GB: raise the threshold, now "
          "{}",
          n, n, 1e-9 * static_cast<double>(options.most_bytes), options.threshold);
  });
  return join(std::move(blocks), n);
}

}  // namespace radiosity

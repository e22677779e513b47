#include "kernels/sparse_powers.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"

#include <algorithm>
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

struct SparseRow {
  std::vector<std::int32_t> column;
  std::vector<double> value;

  double norm() const {
    return std::sqrt(std::inner_product(value.begin(), value.end(), value.begin(), 0.0));
  }
};

/// The series of one row after another.
class RowSeries {
 public:
  RowSeries(const CsrMatrix<double>& first, const SparsePowersOptions& options)
      : first_(first), options_(options), sum_(zeros()), product_(zeros()) {}

  /// Sums row i; what was there before is forgotten.
  void run(Index i) {
    std::fill(sum_.begin(), sum_.end(), 0.0);
    power_ = row_of_first(i);
    remainder_ = 0;
    const double first_norm = power_.norm();
    double norm = first_norm;
    for (powers_ = 0; !power_.column.empty();) {
      for (std::size_t k = 0; k < power_.column.size(); ++k)
        sum_[static_cast<std::size_t>(power_.column[k])] += power_.value[k];
      ++powers_;
      if (powers_ > 1 && has_ended(std::exchange(norm, power_.norm()), norm)) return;
      if (norm > endless_growth * first_norm)
        fail("the powers of a matrix grow without end: its spectral radius is above 1");
      if (powers_ == options_.most_powers) return;
      multiply_power();
    }
    remainder_ = 0;
  }

  const std::vector<double>& sum() const { return sum_; }
  int powers() const { return powers_; }
  double remainder() const { return remainder_; }

 private:
  std::vector<double> zeros() const {
    return std::vector<double>(static_cast<std::size_t>(first_.cols), 0.0);
  }

  SparseRow row_of_first(Index i) const {
    const auto begin = first_.row_begin[static_cast<std::size_t>(i)];
    const auto end = first_.row_begin[static_cast<std::size_t>(i) + 1];
    return {{first_.column.begin() + begin, first_.column.begin() + end},
            {first_.value.begin() + begin, first_.value.begin() + end}};
  }

  /// Further powers as a geometric series of the last two norms.
  bool has_ended(double before, double norm) {
    const double sum_norm = std::sqrt(std::inner_product(sum_.begin(), sum_.end(), sum_.begin(), 0.0));
    const double ratio = norm / before;
    remainder_ = ratio < 1 ? norm * ratio / (1 - ratio) / sum_norm : norm / sum_norm;
    return ratio < 1 && remainder_ <= single_roundoff;
  }

  /// The next power of the row, without its small entries.
  void multiply_power() {
    for (std::size_t k = 0; k < power_.column.size(); ++k) {
      const double factor = power_.value[k];
      const auto row = static_cast<std::size_t>(power_.column[k]);
      const auto end = static_cast<std::size_t>(first_.row_begin[row + 1]);
      for (auto entry = static_cast<std::size_t>(first_.row_begin[row]); entry < end; ++entry)
        product_[static_cast<std::size_t>(first_.column[entry])] += factor * first_.value[entry];
    }
    power_.column.clear();
    power_.value.clear();
    for (std::size_t j = 0; j < product_.size(); ++j) {
      const double entry = std::exchange(product_[j], 0.0);
      if (entry == 0 || !(std::fabs(entry) >= options_.threshold)) continue;
      power_.column.push_back(static_cast<std::int32_t>(j));
      power_.value.push_back(entry);
    }
  }

  const CsrMatrix<double>& first_;
  const SparsePowersOptions& options_;
  std::vector<double> sum_;
  std::vector<double> product_;  ///< 0 between products
  SparseRow power_;
  int powers_ = 0;
  double remainder_ = 0;
};

/// Consecutive rows of the sum, in M's own entries.
struct Rows {
  std::vector<std::int64_t> counts;
  std::vector<std::int32_t> column;
  std::vector<float> value;
  int powers = 0;
  double remainder = 0;

  void append(const RowSeries& series, Index i, const Eigen::VectorXd& weights) {
    const std::size_t before = column.size();
    for (std::size_t j = 0; j < series.sum().size(); ++j) {
      const auto entry = static_cast<float>(series.sum()[j] * weights[static_cast<Index>(j)] / weights[i]);
      if (entry == 0) continue;
      column.push_back(static_cast<std::int32_t>(j));
      value.push_back(entry);
    }
    counts.push_back(static_cast<std::int64_t>(column.size() - before));
    powers = std::max(powers, series.powers());
    remainder = std::max(remainder, series.remainder());
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
  constexpr Index rows_together = 16;
  std::vector<Rows> blocks(static_cast<std::size_t>((n + rows_together - 1) / rows_together));
  std::atomic<std::size_t> entries = 0;
  parallel_for(blocks.size(), [&](std::size_t block) {
    RowSeries series(first, options);
    const Index begin = static_cast<Index>(block) * rows_together;
    for (Index i = begin; i < std::min(n, begin + rows_together); ++i) {
      series.run(i);
      blocks[block].append(series, i, weights);
    }
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

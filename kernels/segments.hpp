#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace radiosity {

using Index = Eigen::Index;

/// A sparse V of n x k with one number a row (document 004, Eq. 6 and Section 4.1): its rows sorted by
/// column, so that column p owns the sorted positions offsets[p] ... offsets[p + 1] - 1. O(k) numbers where
/// all entries are 1 and fields come sorted.
class Segments {
 public:
  /// `offsets`: k + 1 numbers that never fall, from 0 to n. `weights`: V's number at each sorted position;
  /// empty: all 1. `order`: the row at each sorted position, each of 0 ... n - 1 once; empty: rows are sorted
  /// already. Throws UsageError where that does not hold, and where a weight is not finite.
  explicit Segments(std::vector<std::int64_t> offsets, std::vector<double> weights = {},
                    std::vector<std::int32_t> order = {});

  Index rows() const { return static_cast<Index>(offsets_.back()); }
  Index count() const { return static_cast<Index>(offsets_.size()) - 1; }
  const std::vector<std::int64_t>& offsets() const { return offsets_; }
  const std::vector<double>& weights() const { return weights_; }
  const std::vector<std::int32_t>& order() const { return order_; }

  std::size_t offset_bytes() const { return offsets_.size() * sizeof(std::int64_t); }
  std::size_t weight_bytes() const { return weights_.size() * sizeof(double); }
  std::size_t order_bytes() const { return order_.size() * sizeof(std::int32_t); }

 private:
  std::vector<std::int64_t> offsets_;
  std::vector<double> weights_;
  std::vector<std::int32_t> order_;
};

/// The rows of a matrix with one number a row, sorted by column: row e belongs to column segment[e] of
/// 0 ... count - 1. Rows of a column keep their order. `weights`: V's number in each row, in the order of the
/// rows; empty: all 1. Throws UsageError where a segment does not exist.
Segments sort_by_segment(const std::vector<std::int32_t>& segment, Index count,
                         const std::vector<double>& weights = {});

}  // namespace radiosity

#include "kernels/segments.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace radiosity {
namespace {

void check_offsets(const std::vector<std::int64_t>& offsets) {
  if (offsets.empty() || offsets.front() != 0)
    fail<UsageError>("the offsets of segments begin with 0: {}",
                     offsets.empty() ? "there are none" : "these begin with another number");
  if (!std::is_sorted(offsets.begin(), offsets.end()))
    fail<UsageError>("the offsets of segments fall: a segment cannot end before it begins");
}

void check_order(const std::vector<std::int32_t>& order) {
  std::vector<bool> seen(order.size(), false);
  for (const std::int32_t row : order) {
    if (row < 0 || static_cast<std::size_t>(row) >= order.size() || seen[static_cast<std::size_t>(row)])
      fail<UsageError>("the order of {} rows is not a permutation: row {} is out of range or comes twice",
                       order.size(), row);
    seen[static_cast<std::size_t>(row)] = true;
  }
}

}  // namespace

Segments::Segments(std::vector<std::int64_t> offsets, std::vector<double> weights,
                   std::vector<std::int32_t> order)
    : offsets_(std::move(offsets)), weights_(std::move(weights)), order_(std::move(order)) {
  check_offsets(offsets_);
  const auto n = static_cast<std::size_t>(rows());
  if ((!weights_.empty() && weights_.size() != n) || (!order_.empty() && order_.size() != n))
    fail<UsageError>("segments of {} rows come with {} weights and an order of {}", n, weights_.size(),
                     order_.size());
  if (!std::all_of(weights_.begin(), weights_.end(), [](double weight) { return std::isfinite(weight); }))
    fail<UsageError>("the weight of a row is not a finite number");
  check_order(order_);
}

Segments sort_by_segment(const std::vector<std::int32_t>& segment, Index count,
                         const std::vector<double>& weights) {
  std::vector<std::int64_t> offsets(static_cast<std::size_t>(std::max<Index>(count, 0)) + 1, 0);
  for (const std::int32_t p : segment) {
    if (p < 0 || p >= count) fail<UsageError>("a row belongs to segment {} of {}", p, count);
    ++offsets[static_cast<std::size_t>(p) + 1];
  }
  if (!weights.empty() && weights.size() != segment.size())
    fail<UsageError>("{} rows come with {} weights", segment.size(), weights.size());
  for (std::size_t p = 1; p < offsets.size(); ++p) offsets[p] += offsets[p - 1];

  std::vector<std::int64_t> next(offsets.begin(), offsets.end() - 1);
  std::vector<std::int32_t> order(segment.size());
  std::vector<double> sorted_weights(weights.size());
  for (std::size_t e = 0; e < segment.size(); ++e) {
    const auto s = static_cast<std::size_t>(next[static_cast<std::size_t>(segment[e])]++);
    order[s] = static_cast<std::int32_t>(e);
    if (!weights.empty()) sorted_weights[s] = weights[e];
  }
  return Segments(std::move(offsets), std::move(sorted_weights), std::move(order));
}

}  // namespace radiosity

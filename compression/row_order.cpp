#include "compression/row_order.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace radiosity {
namespace {

using Eigen::Index;
using Order = std::vector<Index>;

/// Of each row the nearest others, the nearest first.
std::vector<Order> nearest_rows(const Eigen::MatrixXd& squared) {
  constexpr std::ptrdiff_t most = 10;
  std::vector<Order> nearest(static_cast<std::size_t>(squared.rows()));
  parallel_for(nearest.size(), [&](std::size_t row) {
    Order others(nearest.size());
    std::iota(others.begin(), others.end(), 0);
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(row));
    const auto end = others.begin() + std::min(most, static_cast<std::ptrdiff_t>(others.size()));
    const auto distance = squared.col(static_cast<Index>(row));
    std::partial_sort(others.begin(), end, others.end(), [&](Index a, Index b) {
      return std::pair(distance[a], a) < std::pair(distance[b], b);
    });
    nearest[row].assign(others.begin(), end);
  });
  return nearest;
}

/// A path through all rows whose parts can be turned around; places are counted from 0.
class OpenPath {
 public:
  OpenPath(const Eigen::MatrixXd& squared, Order order)
      : squared_(squared), order_(std::move(order)), place_(order_.size(), -1) {
    require_order();
    for (Index p = 0; p < size(); ++p) place_[static_cast<std::size_t>(at(p))] = p;
  }

  Index size() const { return static_cast<Index>(order_.size()); }
  Index at(Index place) const { return order_[static_cast<std::size_t>(place)]; }
  Index place(Index row) const { return place_[static_cast<std::size_t>(row)]; }
  const Order& order() const { return order_; }
  double between_rows(Index a, Index b) const { return std::sqrt(squared_(a, b)); }
  /// Distance of the rows at two places, 0 beyond the end, where nothing follows.
  double between(Index p, Index q) const { return std::max(p, q) < size() ? between_rows(at(p), at(q)) : 0; }

  /// Turns around what stands at the places from `first` to `last` if that shortens the path; the place
  /// before `first` must exist.
  bool turn_if_shorter(Index first, Index last) {
    const double before = between(first - 1, first) + between(last, last + 1);
    const double after = between(first - 1, last) + between(first, last + 1);
    constexpr double rounding = 1e-12;
    if (!(after < before * (1 - rounding))) return false;
    std::reverse(order_.begin() + first, order_.begin() + last + 1);
    for (Index p = first; p <= last; ++p) place_[static_cast<std::size_t>(at(p))] = p;
    return true;
  }

 private:
  void require_order() const {
    Order sorted = order_;
    std::sort(sorted.begin(), sorted.end());
    bool complete = size() == squared_.rows();
    for (Index i = 0; complete && i < size(); ++i) complete = sorted[static_cast<std::size_t>(i)] == i;
    if (!complete)
      fail<UsageError>("an order of {} rows names each of them once; this one does not", squared_.rows());
  }

  const Eigen::MatrixXd& squared_;
  Order order_, place_;
};

/// Looks for a turn that puts a near row b beside row a, where the one that stands there is farther.
bool improve_at(OpenPath& path, Index a, const Order& near_rows) {
  const Index i = path.place(a);
  for (const Index b : near_rows) {
    const Index j = path.place(b);
    const double distance = path.between_rows(a, b);
    const bool after = i + 1 < path.size() && distance < path.between(i, i + 1);
    const bool before = i > 0 && distance < path.between(i - 1, i);
    if (!after && !before) return false;  // the other near rows are farther still
    // b takes the place after a, or a that after b.
    if (after && path.turn_if_shorter(std::min(i, j) + 1, std::max(i, j))) return true;
    // b takes the place before a, or a that before b; the first row stays.
    if (before && std::min(i, j) > 0 && path.turn_if_shorter(std::min(i, j), std::max(i, j) - 1)) return true;
  }
  return false;
}

}  // namespace

Order greedy_order(const Eigen::MatrixXd& squared_distances) {
  const Index n = squared_distances.rows();
  Order order, left(static_cast<std::size_t>(n));
  order.reserve(left.size());
  std::iota(left.begin(), left.end(), 0);
  auto next = left.begin();
  while (!left.empty()) {
    order.push_back(*next);
    left.erase(next);  // the rows left stay sorted, so that the first of equals is found
    const auto distance = squared_distances.col(order.back());
    next = std::min_element(left.begin(), left.end(),
                            [&](Index a, Index b) { return distance[a] < distance[b]; });
  }
  return order;
}

double path_length(const Eigen::MatrixXd& squared_distances, const Order& order) {
  double length = 0;
  for (std::size_t p = 1; p < order.size(); ++p)
    length += std::sqrt(squared_distances(order[p - 1], order[p]));
  return length;
}

Order two_opt_order(const Eigen::MatrixXd& squared_distances, Order start, int passes) {
  OpenPath path(squared_distances, std::move(start));
  const std::vector<Order> nearest = nearest_rows(squared_distances);
  for (int pass = 0; pass < passes; ++pass) {
    bool improved = false;
    for (Index a = 0; a < path.size(); ++a)
      while (improve_at(path, a, nearest[static_cast<std::size_t>(a)])) improved = true;
    if (!improved) break;
  }
  return path.order();
}

}  // namespace radiosity

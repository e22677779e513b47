#include "factorizations/halving_order.hpp"

#include <algorithm>
#include <numeric>

namespace radiosity {
namespace {

using Eigen::Index;
using Place = std::vector<Index>::iterator;

void halve(const Eigen::MatrixXd& coordinates, Place begin, Place end) {
  if (end - begin < 2) return;
  const Eigen::MatrixXd own = coordinates(Eigen::all, std::vector<Index>(begin, end));
  Index axis = 0;
  (own.rowwise().maxCoeff() - own.rowwise().minCoeff()).maxCoeff(&axis);
  std::stable_sort(begin, end, [&](Index a, Index b) { return coordinates(axis, a) < coordinates(axis, b); });
  const Place middle = begin + (end - begin) / 2;
  halve(coordinates, begin, middle);
  halve(coordinates, middle, end);
}

}  // namespace

std::vector<Index> halving_order(const Eigen::MatrixXd& coordinates) {
  std::vector<Index> order(static_cast<std::size_t>(coordinates.cols()));
  std::iota(order.begin(), order.end(), 0);
  halve(coordinates, order.begin(), order.end());
  return order;
}

}  // namespace radiosity

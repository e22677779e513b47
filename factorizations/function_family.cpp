#include "factorizations/function_family.hpp"

#include "factorizations/lapack.hpp"
#include "factorizations/leading_columns.hpp"

#include <algorithm>
#include <numeric>

namespace radiosity {
namespace {

using Eigen::Index;

/// The functions with the largest lengths, at most `count`; none that is 0 but for rounding.
std::vector<Index> longest(const Eigen::VectorXd& lengths, Index count) {
  constexpr double nothing = 1e-14;
  std::vector<Index> order(static_cast<std::size_t>(lengths.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return lengths[a] > lengths[b]; });
  order.resize(std::min(order.size(), static_cast<std::size_t>(count)));
  while (!order.empty() && !(lengths[order.back()] > nothing * lengths[order.front()])) order.pop_back();
  return order;
}

}  // namespace

LowRankPair project_on_functions(const MatrixProducts& A, const FunctionFamily& family, Index rank,
                                 std::uint64_t seed) {
  constexpr Index fewest_products = 64;
  const Eigen::MatrixXd sketch = row_sketch(A, 4 * rank + fewest_products, seed);
  const Eigen::VectorXd lengths = family.coefficients(sketch.transpose()).rowwise().norm();
  LowRankPair pair;
  pair.V = orthonormal_columns(family.columns(longest(lengths, rank)));
  pair.U = A.apply(pair.V);
  return pair;
}

}  // namespace radiosity

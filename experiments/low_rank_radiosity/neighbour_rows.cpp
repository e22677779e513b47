#include "experiments/low_rank_radiosity/neighbour_rows.hpp"

#include "foundation/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

namespace radiosity {
namespace {

/// Pairs (smaller, larger) of each patch and the nearest other one of its face, the first of equals.
std::vector<NeighbourPair> nearest_on_faces(const PatchMesh& mesh) {
  std::set<std::pair<Index, Index>> found;
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    Index nearest = -1;
    double least = std::numeric_limits<double>::infinity();
    for (Index j = 0; j < mesh.patch_count(); ++j) {
      if (j == i ||
          mesh.patches[static_cast<std::size_t>(j)].face != mesh.patches[static_cast<std::size_t>(i)].face)
        continue;
      const double distance = (mesh.centroid.col(i) - mesh.centroid.col(j)).norm();
      if (distance < least * (1 - 1e-9)) {
        least = distance;
        nearest = j;
      }
    }
    if (nearest >= 0) found.emplace(std::min(i, nearest), std::max(i, nearest));
  }
  std::vector<NeighbourPair> pairs;
  pairs.reserve(found.size());
  for (const auto& [first, second] : found) pairs.push_back({first, second});
  return pairs;
}

/// The place of each value in the sorted list; equal values get the mean of theirs.
Eigen::VectorXd ranks_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  Eigen::VectorXd ranks(static_cast<Index>(values.size()));
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first + 1;
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    for (std::size_t k = first; k < end; ++k)
      ranks[static_cast<Index>(order[k])] = 0.5 * static_cast<double>(first + end - 1);
    first = end;
  }
  return ranks;
}

}  // namespace

std::vector<NeighbourPair> neighbouring_pairs(const FormFactors& form_factors, const SceneViews& views) {
  const PatchMesh& mesh = *form_factors.mesh;
  const Eigen::MatrixXd columns = form_factors.matrix().transpose();  // rows of F, each in one piece
  std::vector<NeighbourPair> pairs = nearest_on_faces(mesh);
  parallel_for(pairs.size(), [&](std::size_t p) {
    NeighbourPair& pair = pairs[p];
    const auto a = columns.col(pair.first), b = columns.col(pair.second);
    const double size = std::max(a.norm(), b.norm());
    pair.row_difference = size > 0 ? (a - b).norm() / size : 0;
    pair.redirected = 0.5 * (a - b).cwiseAbs().sum();
    pair.view_difference =
        views.difference(views.from(mesh.centroid.col(pair.first), mesh.normal.col(pair.first)),
                         views.from(mesh.centroid.col(pair.second), mesh.normal.col(pair.second)));
  });
  std::sort(pairs.begin(), pairs.end(), [](const NeighbourPair& a, const NeighbourPair& b) {
    return std::tie(a.row_difference, a.first, a.second) < std::tie(b.row_difference, b.first, b.second);
  });
  return pairs;
}

double rank_correlation(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.empty()) return 0;
  Eigen::VectorXd a = ranks_of(x), b = ranks_of(y);
  a.array() -= a.mean();
  b.array() -= b.mean();
  const double size = a.norm() * b.norm();
  return size > 0 ? a.dot(b) / size : 0;
}

}  // namespace radiosity

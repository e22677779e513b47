#include "form_factors/form_factor_methods.hpp"
#include "foundation/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace radiosity {
namespace {

constexpr Index kTile = SymmetricTiles<double>::tile_size;

// Which tiles of K, in mesh order, the pairs of two clusters can fall into.
class TilePattern {
 public:
  TilePattern(const PatchGeometry& geometry, Index n)
      : rows_((n + kTile - 1) / kTile), present_(static_cast<std::size_t>(rows_ * rows_), 0) {
    for (const PatchCluster& cluster : geometry.clusters()) {
      std::vector<Index> tiles;
      for (int i = cluster.begin; i < cluster.end; ++i) tiles.push_back(geometry.to_mesh(i) / kTile);
      std::sort(tiles.begin(), tiles.end());
      tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
      tiles_.push_back(std::move(tiles));
    }
  }

  void add(std::size_t first, std::size_t second) {
    for (const Index a : tiles_[first])
      for (const Index b : tiles_[second])
        present_[static_cast<std::size_t>(std::min(a, b) * rows_ + std::max(a, b))] = 1;
  }

  bool operator()(Index row, Index column) const {
    return present_[static_cast<std::size_t>(row * rows_ + column)] != 0;
  }

 private:
  Index rows_;
  std::vector<char> present_;
  std::vector<std::vector<Index>> tiles_;
};

// What the pairs of one cluster with all later ones came to.
struct ClusterRow {
  std::uint64_t rays = 0;
  std::map<std::pair<int, int>, double> group_variance;  // of the exchange A_i F_ij, scaled scene
};

void evaluate_row(const PairExchange& exchange, std::size_t own_number, SymmetricTiles<double>& kernel,
                  ClusterRow& row) {
  const PatchGeometry& geometry = exchange.geometry();
  const auto& clusters = geometry.clusters();
  const PatchCluster& own = clusters[own_number];
  ClusterExchange result;
  ExchangeWorkspace workspace = exchange.make_workspace();
  for (std::size_t b = own_number; b < clusters.size(); ++b) {
    const auto pair = exchange.relate(own, clusters[b]);
    if (pair.nothing) continue;
    for (int i = own.begin; i < own.end; ++i) {
      exchange.evaluate(i, pair, i + 1, workspace, result);
      row.rays += result.rays;
      for (int l = 0; l < clusters[b].end - clusters[b].begin; ++l) {
        const int j = clusters[b].begin + l;
        if (result.kernel[l] != 0) kernel.set(geometry.to_mesh(i), geometry.to_mesh(j), result.kernel[l]);
        if (result.variance[l] > 0)
          row.group_variance[{geometry.group(i), geometry.group(j)}] +=
              result.variance[l] * geometry.area(i) * geometry.area(j);
      }
    }
  }
}

// Whether dropping zero tiles is worth a copy of the others.
bool many_zero_tiles(const SymmetricTiles<double>& kernel) {
  std::atomic<Index> zero{0};
  parallel_for(static_cast<std::size_t>(kernel.tile_count()), [&](std::size_t tile) {
    const double* const entries = kernel.tile_data(static_cast<Index>(tile));
    if (std::all_of(entries, entries + kTile * kTile, [](double entry) { return entry == 0; })) ++zero;
  });
  return 10 * zero > kernel.tile_count();
}

Eigen::MatrixXd variance_between_groups(const std::vector<ClusterRow>& rows, const PatchGeometry& geometry,
                                        Index groups) {
  Eigen::MatrixXd variance = Eigen::MatrixXd::Zero(groups, groups);
  for (const ClusterRow& row : rows)
    for (const auto& [pair, value] : row.group_variance) {
      const auto [g, h] = pair;
      // Within a group both directions of a pair carry the same error.
      const double both = g == h ? 4 : 1;
      variance(g, h) += both * value / (geometry.group_area(g) * geometry.group_area(g));
      if (g != h) variance(h, g) += value / (geometry.group_area(h) * geometry.group_area(h));
    }
  return variance;
}

}  // namespace

AssembledKernel assemble_accurate(const PatchMesh& mesh, const PairExchange& exchange, Monitor& monitor) {
  const PatchGeometry& geometry = exchange.geometry();
  const std::size_t clusters = geometry.clusters().size();
  TilePattern pattern(geometry, mesh.patch_count());
  for (std::size_t a = 0; a < clusters; ++a)
    for (std::size_t b = a; b < clusters; ++b)
      if (exchange.may_exchange(geometry.clusters()[a], geometry.clusters()[b])) pattern.add(a, b);

  auto kernel = std::make_shared<SymmetricTiles<double>>(mesh.patch_count(), std::cref(pattern));
  std::vector<ClusterRow> rows(clusters);
  std::atomic<std::size_t> done{0};
  const double pairs = 0.5 * static_cast<double>(clusters) * static_cast<double>(clusters + 1);
  parallel_for(clusters, [&](std::size_t a) {
    evaluate_row(exchange, a, *kernel, rows[a]);
    monitor.checkpoint("form factors", static_cast<double>(done += clusters - a) / pairs);
  });

  AssembledKernel result;
  for (const ClusterRow& row : rows) result.rays += row.rays;
  result.group_variance =
      variance_between_groups(rows, geometry, static_cast<Index>(mesh.scene->groups.size()));
  result.kernel = many_zero_tiles(*kernel)
                      ? std::make_shared<SymmetricTiles<double>>(kernel->without_zero_tiles())
                      : kernel;
  return result;
}

}  // namespace radiosity

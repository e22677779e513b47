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

// A piece of the work: patches first ... last - 1 of a cluster with this and all later clusters.
struct Task {
  std::size_t cluster;
  int first, last;
};

// Whole clusters share what is known of a pair of clusters; a scene of few clusters is cut finer, for all
// threads.
std::vector<Task> make_tasks(const std::vector<PatchCluster>& clusters) {
  constexpr std::size_t enough = 64;
  const int size = clusters.size() >= enough ? PatchGeometry::cluster_size : 1;
  std::vector<Task> tasks;
  for (std::size_t c = 0; c < clusters.size(); ++c)
    for (int first = clusters[c].begin; first < clusters[c].end; first += size)
      tasks.push_back({c, first, std::min(first + size, clusters[c].end)});
  return tasks;
}

// What the pairs of one task came to.
struct TaskResult {
  std::uint64_t rays = 0;
  std::map<std::pair<int, int>, double> group_variance;  // of the exchange A_i F_ij, scaled scene
};

TaskResult evaluate(const PairExchange& exchange, const Task& task, SymmetricTiles<double>& kernel,
                    const Monitor& monitor) {
  const PatchGeometry& geometry = exchange.geometry();
  const auto& clusters = geometry.clusters();
  TaskResult total;
  ClusterExchange result;
  ExchangeWorkspace workspace = exchange.make_workspace();
  for (std::size_t b = task.cluster; b < clusters.size(); ++b) {
    const auto pair = exchange.relate(clusters[task.cluster], clusters[b]);
    if (pair.nothing) continue;
    if (monitor.cancelled()) throw Cancelled();
    for (int i = task.first; i < task.last; ++i) {
      exchange.evaluate(i, pair, i + 1, workspace, result);
      total.rays += result.rays;
      for (int l = 0; l < clusters[b].end - clusters[b].begin; ++l) {
        const int j = clusters[b].begin + l;
        if (result.kernel[l] != 0) kernel.set(geometry.to_mesh(i), geometry.to_mesh(j), result.kernel[l]);
        if (result.variance[l] > 0)
          total.group_variance[{geometry.group(i), geometry.group(j)}] +=
              result.variance[l] * geometry.area(i) * geometry.area(j);
      }
    }
  }
  return total;
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

Eigen::MatrixXd variance_between_groups(const std::vector<TaskResult>& results, const PatchGeometry& geometry,
                                        Index groups) {
  Eigen::MatrixXd variance = Eigen::MatrixXd::Zero(groups, groups);
  for (const TaskResult& result : results)
    for (const auto& [pair, value] : result.group_variance) {
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
  const std::vector<Task> tasks = make_tasks(geometry.clusters());
  std::vector<TaskResult> results(tasks.size());
  std::atomic<std::size_t> done{0};
  const double pairs = 0.5 * static_cast<double>(tasks.size()) * static_cast<double>(tasks.size() + 1);
  parallel_for(tasks.size(), [&](std::size_t t) {
    results[t] = evaluate(exchange, tasks[t], *kernel, monitor);
    monitor.checkpoint("form factors", static_cast<double>(done += tasks.size() - t) / pairs);
  });

  AssembledKernel result;
  for (const TaskResult& part : results) result.rays += part.rays;
  result.group_variance =
      variance_between_groups(results, geometry, static_cast<Index>(mesh.scene->groups.size()));
  result.kernel = many_zero_tiles(*kernel)
                      ? std::make_shared<SymmetricTiles<double>>(kernel->without_zero_tiles())
                      : kernel;
  return result;
}

}  // namespace radiosity

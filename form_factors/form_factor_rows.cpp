#include "form_factors/form_factor_rows.hpp"

#include "form_factors/pair_exchange.hpp"
#include "foundation/parallel.hpp"

#include <atomic>
#include <cmath>
#include <vector>

namespace radiosity {

FormFactorRows::FormFactorRows(std::shared_ptr<const PatchMesh> mesh, double tolerance, std::uint64_t seed)
    : mesh_(std::move(mesh)), exchange_(std::make_unique<PairExchange>(*mesh_, tolerance, seed)) {}

FormFactorRows::~FormFactorRows() = default;

Index FormFactorRows::patch_count() const {
  return mesh_->patch_count();
}

void FormFactorRows::fill_row(Index i, const std::vector<char>* wanted, Eigen::VectorXd& row) const {
  if (i < 0 || i >= patch_count())
    fail<UsageError>("there is no patch {}: the scene has {}", i, patch_count());
  const PatchGeometry& geometry = exchange_->geometry();
  const int own = geometry.from_mesh(i);
  const PatchCluster& own_cluster = geometry.cluster_of(own);
  ExchangeWorkspace workspace = exchange_->make_workspace();
  ClusterExchange result;
  row.setZero(patch_count());
  for (const PatchCluster& cluster : geometry.clusters()) {
    if (wanted && !(*wanted)[static_cast<std::size_t>(cluster.number)]) continue;
    // In the order of the assembly, whose lower cluster always comes first.
    const bool forward = own_cluster.number <= cluster.number;
    auto pair = forward ? exchange_->relate(own_cluster, cluster) : exchange_->relate(cluster, own_cluster);
    if (pair.nothing) continue;
    pair.other = &cluster;
    exchange_->evaluate(own, pair, 0, workspace, result);
    for (int j = cluster.begin; j < cluster.end; ++j) {
      const double kernel = result.kernel[j - cluster.begin];
      if (kernel != 0) row[geometry.to_mesh(j)] = kernel * std::sqrt(geometry.area(j) / geometry.area(own));
    }
  }
}

Eigen::VectorXd FormFactorRows::row(Index i) const {
  Eigen::VectorXd result;
  fill_row(i, nullptr, result);
  return result;
}

Eigen::VectorXd FormFactorRows::column(Index j) const {
  Eigen::VectorXd result = row(j);
  return (result.array() * mesh_->area[j] / mesh_->area.array()).matrix();
}

Eigen::MatrixXd FormFactorRows::block(std::span<const Index> rows, std::span<const Index> columns) const {
  const PatchGeometry& geometry = exchange_->geometry();
  std::vector<char> wanted(geometry.clusters().size(), 0);
  for (const Index j : columns) {
    if (j < 0 || j >= patch_count())
      fail<UsageError>("there is no patch {}: the scene has {}", j, patch_count());
    wanted[static_cast<std::size_t>(geometry.cluster_of(geometry.from_mesh(j)).number)] = 1;
  }
  Eigen::MatrixXd result(static_cast<Index>(rows.size()), static_cast<Index>(columns.size()));
  parallel_for(rows.size(), [&](std::size_t r) {
    Eigen::VectorXd row;
    fill_row(rows[r], &wanted, row);
    for (std::size_t c = 0; c < columns.size(); ++c)
      result(static_cast<Index>(r), static_cast<Index>(c)) = row[columns[c]];
  });
  return result;
}

Eigen::MatrixXd FormFactorRows::panel(std::span<const int> group_of_patch, Index k, Monitor& monitor) const {
  const Index n = patch_count();
  if (static_cast<Index>(group_of_patch.size()) != n)
    fail<UsageError>("{} patch groups are given for {} patches", group_of_patch.size(), n);
  for (const int group : group_of_patch)
    if (group < -1 || group >= k) fail<UsageError>("patch group {}: it must be -1 or below {}", group, k);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, k);
  std::atomic<Index> done{0};
  parallel_for(static_cast<std::size_t>(n), [&](std::size_t i) {
    Eigen::VectorXd row;
    fill_row(static_cast<Index>(i), nullptr, row);
    for (Index j = 0; j < n; ++j) {
      const int group = group_of_patch[static_cast<std::size_t>(j)];
      if (group >= 0) result(static_cast<Index>(i), group) += row[j];
    }
    if (++done % 64 == 0)
      monitor.checkpoint("form factor panel", static_cast<double>(done) / static_cast<double>(n));
  });
  return result;
}

}  // namespace radiosity

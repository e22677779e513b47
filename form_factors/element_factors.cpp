#include "form_factors/element_factors.hpp"

#include "form_factors/pair_exchange.hpp"
#include "foundation/error.hpp"
#include "foundation/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

namespace radiosity {
namespace {

/// Elements whose geometry is held at once, with the patches beside them.
constexpr Index batch_size = 16384;

/// Enough for the wider tolerance of U; neighbouring elements average what is left.
constexpr std::uint64_t least_rays = 64;

void append(PatchMesh& mesh, const PatchMesh& source, Index patch, int face_offset) {
  Patch copy = source.patches[static_cast<std::size_t>(patch)];
  for (int k = 0; k < copy.corner_count; ++k) {
    copy.corners[static_cast<std::size_t>(k)] = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back(source.corner(patch, k));
  }
  copy.face += face_offset;
  const Index at = mesh.patch_count();
  mesh.patches.push_back(copy);
  mesh.area[at] = source.area[patch];
  mesh.normal.col(at) = source.normal.col(patch);
  mesh.centroid.col(at) = source.centroid.col(patch);
}

/// Some elements, then all patches, as one mesh. Faces of the patches get numbers of their own, so that no
/// cluster mixes patches with elements.
PatchMesh joined_mesh(const PatchMesh& elements, std::span<const Index> batch, const PatchMesh& patches) {
  PatchMesh mesh;
  mesh.scene = elements.scene;
  mesh.topology = elements.topology;
  const Index n = static_cast<Index>(batch.size()) + patches.patch_count();
  mesh.patches.reserve(static_cast<std::size_t>(n));
  mesh.vertices.reserve(static_cast<std::size_t>(4 * n));
  mesh.area.resize(n);
  mesh.normal.resize(3, n);
  mesh.centroid.resize(3, n);
  for (const Index e : batch) append(mesh, elements, e, 0);
  const auto faces = static_cast<int>(elements.scene->faces.size());
  for (Index p = 0; p < patches.patch_count(); ++p) append(mesh, patches, p, faces);
  return mesh;
}

/// Some elements and all patches, which follow them in the joined mesh.
struct Batch {
  std::span<const Index> elements;
  const ElementFactorChoice& wanted;

  Index count() const { return static_cast<Index>(elements.size()); }
  bool wants(Index row, Index patch) const {
    return !wanted || wanted(elements[static_cast<std::size_t>(row)], patch);
  }
};

/// F_ep for the elements of one cluster that are elements, into rows of `factors`.
std::uint64_t fill_cluster(const PairExchange& exchange, const PatchCluster& own, const Batch& batch,
                           const Monitor& monitor, Eigen::MatrixXd& factors) {
  const PatchGeometry& geometry = exchange.geometry();
  const Index elements = batch.count();
  ExchangeWorkspace workspace = exchange.make_workspace();
  ClusterExchange result;
  bool wanted[PairHeights::capacity];
  std::uint64_t rays = 0;
  for (const PatchCluster& cluster : geometry.clusters()) {
    // Within a cluster, patches are sorted by their place in the joined mesh: elements come first.
    if (geometry.to_mesh(cluster.end - 1) < elements) continue;
    if (monitor.cancelled()) throw Cancelled();
    const auto pair = exchange.relate(own, cluster);
    if (pair.nothing) continue;
    for (int i = own.begin; i < own.end; ++i) {
      if (geometry.to_mesh(i) >= elements) continue;
      const Index row = geometry.to_mesh(i);
      bool any = false;
      for (int j = cluster.begin; j < cluster.end; ++j) {
        const Index patch = geometry.to_mesh(j) - elements;
        wanted[j - cluster.begin] = patch >= 0 && batch.wants(row, patch);
        any = any || wanted[j - cluster.begin];
      }
      if (!any) continue;
      exchange.evaluate(i, pair, 0, workspace, result, wanted);
      rays += result.rays;
      for (int j = cluster.begin; j < cluster.end; ++j)
        if (wanted[j - cluster.begin])
          factors(row, geometry.to_mesh(j) - elements) =
              result.kernel[j - cluster.begin] * std::sqrt(geometry.area(j) / geometry.area(i));
    }
  }
  return rays;
}

}  // namespace

std::uint64_t compute_element_factors(const PatchMesh& elements, std::span<const Index> order,
                                      const PatchMesh& patches, const ElementFactorOptions& options,
                                      const ElementFactorSink& sink, Monitor& monitor) {
  const auto n = static_cast<Index>(order.size());
  if (n != elements.patch_count())
    fail<UsageError>("{} elements are wanted of a mesh of {}", n, elements.patch_count());
  std::atomic<std::uint64_t> rays{0};
  for (Index first = 0; first < n; first += batch_size) {
    const Index count = std::min(batch_size, n - first);
    const Batch batch{order.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count)),
                      options.wanted};
    const PairExchange exchange(joined_mesh(elements, batch.elements, patches), options.tolerance,
                                options.seed + static_cast<std::uint64_t>(first), least_rays);
    Eigen::MatrixXd factors = Eigen::MatrixXd::Zero(count, patches.patch_count());
    const std::vector<PatchCluster>& clusters = exchange.geometry().clusters();
    parallel_for(clusters.size(), [&](std::size_t c) {
      rays += fill_cluster(exchange, clusters[c], batch, monitor, factors);
    });
    sink(first, factors);
    monitor.checkpoint("form factors between two meshes",
                       static_cast<double>(first + count) / static_cast<double>(n));
  }
  return rays;
}

}  // namespace radiosity

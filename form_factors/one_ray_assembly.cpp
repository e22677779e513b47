#include "form_factors/form_factor_methods.hpp"
#include "foundation/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <vector>

namespace radiosity {
namespace {

using Eigen::Vector3d;

Vector3d sample_point(const ConvexPolygon& polygon) {
  Vector3d sum = Vector3d::Zero();
  if (polygon.corner_count() != 3) {
    for (int k = 0; k < polygon.corner_count(); ++k) sum += polygon[k] / polygon.corner_count();
    return sum;
  }
  // The incircle centre: corners weighted by the lengths of the opposite edges.
  double perimeter = 0;
  for (int k = 0; k < 3; ++k) {
    const double opposite = (polygon[(k + 1) % 3] - polygon[(k + 2) % 3]).norm();
    sum += opposite * polygon[k];
    perimeter += opposite;
  }
  return sum / perimeter;
}

}  // namespace

AssembledKernel assemble_one_ray(const PatchMesh& mesh, const PatchGeometry& geometry,
                                 const Occluders& occluders, Monitor& monitor) {
  const int n = geometry.patch_count();
  std::vector<Vector3d> points;
  points.reserve(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) points.push_back(sample_point(geometry.polygon(i)));
  AssembledKernel result;
  result.kernel =
      std::make_shared<SymmetricTiles<double>>(mesh.patch_count(), [](Index, Index) { return true; });
  SymmetricTiles<double>& kernel = *result.kernel;
  std::vector<std::uint64_t> rays(static_cast<std::size_t>(n), 0);
  std::atomic<int> done{0};
  parallel_for(static_cast<std::size_t>(n), [&](std::size_t row) {
    const auto i = static_cast<int>(row);
    RayPacket packet;
    double value[RayPacket::size];
    int partner[RayPacket::size];
    int waiting = 0;
    const auto flush = [&] {
      for (int l = waiting; l < RayPacket::size; ++l) packet.active[l] = 0;
      if (!occluders.blockers().empty()) {
        occluders.trace(packet);
        rays[row] += static_cast<std::uint64_t>(waiting);
      }
      for (int l = 0; l < waiting; ++l)
        if (occluders.blockers().empty() || !packet.blocked[l])
          kernel.set(geometry.to_mesh(i), geometry.to_mesh(partner[l]), value[l]);
      waiting = 0;
    };
    const Vector3d start =
        points[row] + PairSampler::stand_off(geometry.polygon(i)) * geometry.plane(i).normal;
    for (int j = i + 1; j < n; ++j) {
      const Vector3d d = points[static_cast<std::size_t>(j)] - points[row];
      const double leaving = d.dot(geometry.plane(i).normal), arriving = -d.dot(geometry.plane(j).normal);
      if (leaving <= coplanar_slack || arriving <= coplanar_slack) continue;
      const double square = d.squaredNorm();
      const Vector3d end = points[static_cast<std::size_t>(j)] +
                           PairSampler::stand_off(geometry.polygon(j)) * geometry.plane(j).normal;
      value[waiting] = leaving * arriving / (std::numbers::pi * square * square) *
                       std::sqrt(geometry.area(i) * geometry.area(j));
      partner[waiting] = j;
      packet.origin_x[waiting] = static_cast<float>(start.x());
      packet.origin_y[waiting] = static_cast<float>(start.y());
      packet.origin_z[waiting] = static_cast<float>(start.z());
      packet.target_x[waiting] = static_cast<float>(end.x());
      packet.target_y[waiting] = static_cast<float>(end.y());
      packet.target_z[waiting] = static_cast<float>(end.z());
      packet.active[waiting] = -1;
      if (++waiting == RayPacket::size) flush();
    }
    for (int l = waiting; l < RayPacket::size; ++l) {
      packet.origin_x[l] = packet.origin_y[l] = packet.origin_z[l] = 0;
      packet.target_x[l] = packet.target_y[l] = packet.target_z[l] = 0;
    }
    flush();
    if (++done % 64 == 0) monitor.checkpoint("form factors (one ray)", static_cast<double>(done) / n);
  });
  for (const std::uint64_t count : rays) result.rays += count;
  result.kernel = std::make_shared<SymmetricTiles<double>>(kernel.without_zero_tiles());
  return result;
}

}  // namespace radiosity

#include "form_factors/unobstructed_exchange.hpp"

#include "form_factors/contour_exchange.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {

UnobstructedExchange::UnobstructedExchange(const PatchGeometry& geometry, double tolerance)
    : geometry_(geometry), tolerance_(tolerance) {
  for (int order = 0; order < QuadraturePoints::orders; ++order)
    for (const bool triangles : {false, true})
      least_ratio_[triangles ? 1 : 0][static_cast<std::size_t>(order)] =
          QuadraturePoints::least_ratio(order, tolerance, triangles);
}

double UnobstructedExchange::by_contour(int i, int j) const {
  // One order of the two, so that F_ij and F_ji come from the same number.
  const int first = std::min(i, j), second = std::max(i, j);
  const double slack = coplanar_slack;
  const ConvexPolygon a = clip(geometry_.polygon(first), geometry_.plane(second), slack);
  if (a.corner_count() < 3) return 0;
  const ConvexPolygon b = clip(geometry_.polygon(second), geometry_.plane(first), slack);
  if (b.corner_count() < 3) return 0;
  return contour_exchange(a, b, tolerance_);
}

void UnobstructedExchange::with_cluster(int i, const PatchCluster& cluster, double* exchange) const {
  const int count = cluster.end - cluster.begin;
  const double slack = coplanar_slack;
  PairHeights heights;
  geometry_.quadrature().classify(i, cluster.begin, cluster.end, heights);

  // Per patch: 0 none, 1 close or straddling, 2 + order for product quadrature.
  std::array<signed char, PairHeights::capacity> way{};
  int lowest = QuadraturePoints::orders, highest = -1;
  const bool own_triangle = geometry_.polygon(i).corner_count() == 3;
  const bool triangles = own_triangle || geometry_.polygon(cluster.begin).corner_count() == 3;
  const auto& least = least_ratio_[triangles ? 1 : 0];
  for (int l = 0; l < count; ++l) {
    const int j = cluster.begin + l;
    if (heights.other_high[l] <= slack || heights.own_high[l] <= slack) continue;
    way[static_cast<std::size_t>(l)] = 1;
    if (heights.other_low[l] < -slack || heights.own_low[l] < -slack) continue;
    const double reach = std::max(geometry_.radius(i), geometry_.radius(j));
    for (int order = 0; order < QuadraturePoints::orders; ++order) {
      const double ratio = least[static_cast<std::size_t>(order)] * reach;
      if (heights.distance_squared[l] >= ratio * ratio) {
        way[static_cast<std::size_t>(l)] = static_cast<signed char>(2 + order);
        lowest = std::min(lowest, order), highest = std::max(highest, order);
        break;
      }
    }
  }

  std::array<double, PairHeights::capacity> values;
  std::fill(exchange, exchange + count, 0.0);
  for (int order = lowest; order <= highest; ++order) {
    const auto wanted = static_cast<signed char>(2 + order);
    if (std::find(way.begin(), way.begin() + count, wanted) == way.begin() + count) continue;
    geometry_.quadrature().exchange(order, i, cluster.begin, cluster.end, values.data());
    for (int l = 0; l < count; ++l)
      if (way[static_cast<std::size_t>(l)] == wanted)
        exchange[l] = std::max(0.0, values[static_cast<std::size_t>(l)]);
  }
  for (int l = 0; l < count; ++l)
    if (way[static_cast<std::size_t>(l)] == 1) exchange[l] = by_contour(i, cluster.begin + l);
}

}  // namespace radiosity

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

int UnobstructedExchange::order_for(double radius, double distance_squared, bool triangles) const {
  int order = 0;
  for (const double least : least_ratio_[triangles ? 1 : 0]) {
    if (distance_squared >= least * least * radius * radius) return order;
    ++order;
  }
  return order;
}

void UnobstructedExchange::with_cluster(int i, const PatchCluster& cluster, double* exchange) const {
  constexpr int orders = QuadraturePoints::orders;
  const int count = cluster.end - cluster.begin;
  const double slack = coplanar_slack;
  PairHeights heights;
  geometry_.quadrature().classify(i, cluster.begin, cluster.end, heights);

  // Per patch: 0 none, 1 close or straddling, 2 + own order * orders + other order for product quadrature.
  // Each of the two needs the order that fits its own size: small elements few points even before large
  // patches.
  std::array<signed char, PairHeights::capacity> way{};
  std::array<bool, std::size_t{orders} * orders> used{};
  const bool triangles =
      geometry_.polygon(i).corner_count() == 3 || geometry_.polygon(cluster.begin).corner_count() == 3;
  for (int l = 0; l < count; ++l) {
    const int j = cluster.begin + l;
    if (heights.other_high[l] <= slack || heights.own_high[l] <= slack) continue;
    way[static_cast<std::size_t>(l)] = 1;
    if (heights.other_low[l] < -slack || heights.own_low[l] < -slack) continue;
    const int own = order_for(geometry_.radius(i), heights.distance_squared[l], triangles);
    const int other = order_for(geometry_.radius(j), heights.distance_squared[l], triangles);
    if (own == orders || other == orders) continue;
    way[static_cast<std::size_t>(l)] = static_cast<signed char>(2 + own * orders + other);
    used[static_cast<std::size_t>(own * orders + other)] = true;
  }

  std::array<double, PairHeights::capacity> values;
  std::fill(exchange, exchange + count, 0.0);
  for (int pair = 0; pair < orders * orders; ++pair) {
    if (!used[static_cast<std::size_t>(pair)]) continue;
    geometry_.quadrature().exchange(pair / orders, pair % orders, i, cluster.begin, cluster.end,
                                    values.data());
    for (int l = 0; l < count; ++l)
      if (way[static_cast<std::size_t>(l)] == 2 + pair)
        exchange[l] = std::max(0.0, values[static_cast<std::size_t>(l)]);
  }
  for (int l = 0; l < count; ++l)
    if (way[static_cast<std::size_t>(l)] == 1) exchange[l] = by_contour(i, cluster.begin + l);
}

}  // namespace radiosity

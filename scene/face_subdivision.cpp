#include "scene/face_subdivision.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

namespace radiosity {
namespace {

// Lengths that exceed a whole number of edges by less than this (relative) do not need another cell.
constexpr double kRounding = 1e-9;

std::size_t longest_edge(const Polygon& triangle) {
  std::size_t longest = 0;
  double length = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double candidate = (triangle[(k + 1) % 3] - triangle[k]).squaredNorm();
    if (candidate <= length) continue;
    longest = k;
    length = candidate;
  }
  return longest;
}

double edge_length(const Polygon& polygon, std::size_t k) {
  return (polygon[(k + 1) % polygon.size()] - polygon[k]).norm();
}

std::array<Polygon, 2> halves(const Polygon& triangle, std::size_t k) {
  const Vector3 &a = triangle[k], &b = triangle[(k + 1) % 3], &c = triangle[(k + 2) % 3];
  const Vector3 middle = 0.5 * (a + b);
  return {Polygon{a, middle, c}, Polygon{middle, b, c}};
}

template <typename Visit>
void visit_parts(const Polygon& triangle, double edge, int passes, int depth, const Visit& visit) {
  const std::size_t k = longest_edge(triangle);
  if (edge_length(triangle, k) <= edge * (1 + kRounding) || (passes > 0 && depth == passes))
    return visit(triangle);
  for (const Polygon& half : halves(triangle, k)) visit_parts(half, edge, passes, depth + 1, visit);
}

}  // namespace

std::int64_t cells_along(double length, double edge) {
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(length / edge * (1 - kRounding))));
}

GridSize grid_size(const Polygon& quad, double edge) {
  const auto cells = [&](std::size_t k) {
    return cells_along(std::max(edge_length(quad, k), edge_length(quad, k + 2)), edge);
  };
  return {.rows = cells(1), .columns = cells(0)};
}

std::vector<Polygon> grid(const Polygon& quad, GridSize size) {
  const auto point = [&](std::int64_t row, std::int64_t column) -> Vector3 {
    const double u = static_cast<double>(column) / static_cast<double>(size.columns);
    const double v = static_cast<double>(row) / static_cast<double>(size.rows);
    return (1 - v) * ((1 - u) * quad[0] + u * quad[1]) + v * ((1 - u) * quad[3] + u * quad[2]);
  };
  std::vector<Polygon> cells;
  for (std::int64_t row = 0; row < size.rows; ++row)
    for (std::int64_t column = 0; column < size.columns; ++column)
      cells.push_back(
          {point(row, column), point(row, column + 1), point(row + 1, column + 1), point(row + 1, column)});
  return cells;
}

std::vector<Polygon> bisect(const Polygon& triangle, double edge, int passes) {
  std::vector<Polygon> parts;
  visit_parts(triangle, edge, passes, 0, [&](const Polygon& part) { parts.push_back(part); });
  return parts;
}

std::int64_t bisection_count(const Polygon& triangle, double edge, int passes) {
  std::int64_t count = 0;
  visit_parts(triangle, edge, passes, 0, [&](const Polygon&) { ++count; });
  return count;
}

std::vector<std::vector<Polygon>> bisect_to_count(const std::vector<Polygon>& triangles, std::int64_t count) {
  struct Node {
    Polygon triangle;
    std::size_t first_half = 0;  // the other follows it; 0 for a leaf
  };
  std::vector<Node> nodes;
  // Longest first; of equals, the one that was there first.
  using Entry = std::pair<double, std::int64_t>;
  std::priority_queue<Entry> queue;
  const auto add = [&](const Polygon& triangle) {
    queue.emplace(edge_length(triangle, longest_edge(triangle)), -static_cast<std::int64_t>(nodes.size()));
    nodes.push_back({triangle, 0});
  };
  for (const Polygon& triangle : triangles) add(triangle);
  for (auto leaves = static_cast<std::int64_t>(triangles.size()); leaves < count && !queue.empty();
       ++leaves) {
    const auto chosen = static_cast<std::size_t>(-queue.top().second);
    queue.pop();
    nodes[chosen].first_half = nodes.size();
    const Polygon triangle = nodes[chosen].triangle;
    for (const Polygon& half : halves(triangle, longest_edge(triangle))) add(half);
  }

  std::vector<std::vector<Polygon>> parts(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    std::vector<std::size_t> pending = {i};
    while (!pending.empty()) {
      const Node& node = nodes[pending.back()];
      pending.pop_back();
      if (node.first_half == 0) {
        parts[i].push_back(node.triangle);
      } else {
        pending.push_back(node.first_half + 1);
        pending.push_back(node.first_half);
      }
    }
  }
  return parts;
}

}  // namespace radiosity

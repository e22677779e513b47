#include "scene/half_edges.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace radiosity {
namespace {

void pair_twins(std::vector<HalfEdge>& edges) {
  std::vector<int> order(edges.size());
  std::iota(order.begin(), order.end(), 0);
  const auto at = [&](int i) -> HalfEdge& { return edges[static_cast<std::size_t>(i)]; };
  const auto key = [&](int i) {
    return std::make_tuple(std::min(at(i).from, at(i).to), std::max(at(i).from, at(i).to),
                           at(i).from > at(i).to, i);
  };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  for (std::size_t start = 0; start < order.size();) {
    const auto [low, high, ignored, index] = key(order[start]);
    std::size_t middle = start;
    while (middle < order.size() && at(order[middle]).from == low && at(order[middle]).to == high) ++middle;
    std::size_t end = middle;
    while (end < order.size() && at(order[end]).from == high && at(order[end]).to == low) ++end;
    for (std::size_t k = 0; start + k < middle && middle + k < end; ++k) {
      at(order[start + k]).twin = order[middle + k];
      at(order[middle + k]).twin = order[start + k];
    }
    start = end;
  }
}

}  // namespace

std::vector<HalfEdge> half_edges(const Scene& scene, const std::vector<int>& welded) {
  std::vector<HalfEdge> edges;
  edges.reserve(scene.faces.size() * 4);
  for (std::size_t f = 0; f < scene.faces.size(); ++f) {
    const Face& face = scene.faces[f];
    std::vector<int> corners;
    for (int k = 0; k < face.corner_count; ++k) {
      const int vertex = welded[static_cast<std::size_t>(face.corners[static_cast<std::size_t>(k)])];
      if (std::find(corners.begin(), corners.end(), vertex) == corners.end()) corners.push_back(vertex);
    }
    if (corners.size() < 3) continue;
    const int first = static_cast<int>(edges.size()), count = static_cast<int>(corners.size());
    for (int k = 0; k < count; ++k) {
      const int next = (k + 1) % count;
      edges.push_back({corners[static_cast<std::size_t>(k)], corners[static_cast<std::size_t>(next)],
                       static_cast<int>(f), first + next, -1});
    }
  }
  pair_twins(edges);
  return edges;
}

std::vector<std::vector<int>> boundary_loops(const std::vector<HalfEdge>& edges) {
  const auto at = [&](int i) -> const HalfEdge& { return edges[static_cast<std::size_t>(i)]; };
  std::vector<bool> visited(edges.size(), false);
  std::vector<std::vector<int>> loops;
  for (int start = 0; start < static_cast<int>(edges.size()); ++start) {
    if (at(start).twin >= 0 || visited[static_cast<std::size_t>(start)]) continue;
    // Around the end of each edge through the neighbours until one of them ends. The step can be undone, so
    // the loop closes.
    std::vector<int> loop;
    int edge = start;
    do {
      visited[static_cast<std::size_t>(edge)] = true;
      loop.push_back(edge);
      edge = at(edge).next;
      while (at(edge).twin >= 0) edge = at(at(edge).twin).next;
    } while (edge != start);
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace radiosity

#include "scene/conforming_cells.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

namespace radiosity {
namespace {

/// Edges that must be cut alike: those of a quad that lie opposite, and theirs.
class Chains {
 public:
  explicit Chains(const std::vector<Polygon>& faces) : faces_(faces), chain_of_(faces.size()) {
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (faces[f].size() == 4)
        for (std::size_t k = 0; k < 2; ++k) {
          const std::size_t edge = edge_number(faces[f], k);
          join(edge, edge_number(faces[f], k + 2));
          chain_of_[f][k] = edge;
        }
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (faces[f].size() == 4)
        for (std::size_t& chain : chain_of_[f]) chain = root(chain);
  }

  std::size_t size() const { return lengths_.size(); }

  /// The longest edge of a chain; 0 for numbers that stand for no chain.
  double length(std::size_t chain) const { return parents_[chain] == chain ? lengths_[chain] : 0; }

  GridSize grid_size_of(std::size_t face, const std::vector<std::int64_t>& cells) const {
    return {.rows = cells[chain_of_[face][1]], .columns = cells[chain_of_[face][0]]};
  }

  /// Patches of all quads.
  std::int64_t count(const std::vector<std::int64_t>& cells) const {
    std::int64_t sum = 0;
    for (std::size_t f = 0; f < faces_.size(); ++f)
      if (faces_[f].size() == 4) {
        const GridSize size = grid_size_of(f, cells);
        sum += size.rows * size.columns;
      }
    return sum;
  }

 private:
  int vertex_number(const Vector3& point) {
    return vertices_.try_emplace({point.x(), point.y(), point.z()}, static_cast<int>(vertices_.size()))
        .first->second;
  }

  std::size_t edge_number(const Polygon& polygon, std::size_t k) {
    const Vector3 &from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
    const auto [low, high] = std::minmax({vertex_number(from), vertex_number(to)});
    const auto [found, added] = edges_.try_emplace({low, high}, parents_.size());
    if (added) {
      parents_.push_back(found->second);
      lengths_.push_back((to - from).norm());
    }
    return found->second;
  }

  std::size_t root(std::size_t edge) {
    while (parents_[edge] != edge) edge = parents_[edge] = parents_[parents_[edge]];
    return edge;
  }

  void join(std::size_t a, std::size_t b) {
    const auto [low, high] = std::minmax({root(a), root(b)});
    parents_[high] = low;
    lengths_[low] = std::max(lengths_[low], lengths_[high]);
  }

  const std::vector<Polygon>& faces_;
  std::vector<std::array<std::size_t, 2>> chain_of_;  // along the first and the second edge of a quad
  std::map<std::array<double, 3>, int> vertices_;
  std::map<std::pair<int, int>, std::size_t> edges_;
  std::vector<std::size_t> parents_;
  std::vector<double> lengths_;
};

std::vector<std::int64_t> cells_for(const Chains& chains, double edge) {
  std::vector<std::int64_t> cells(chains.size());
  for (std::size_t chain = 0; chain < cells.size(); ++chain)
    cells[chain] = cells_along(chains.length(chain), edge);
  return cells;
}

/// Cuts chains once more, those with the longest cells first, where this does not lead beyond `count`.
void fill_up(const Chains& chains, std::vector<std::int64_t>& cells, double edge, std::int64_t count) {
  const auto cell_length = [&](std::size_t chain) {
    return chains.length(chain) / static_cast<double>(cells[chain]);
  };
  std::vector<std::size_t> order(cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t chain) { return cell_length(chain) < 0.5 * edge; });
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return cell_length(a) > cell_length(b); });
  for (const std::size_t chain : order) {
    ++cells[chain];
    if (chains.count(cells) > count) --cells[chain];
  }
}

}  // namespace

ConformingCells conforming_cells(const std::vector<Polygon>& faces, std::int64_t count) {
  const Chains chains(faces);
  const auto triangle_count = [&](double edge) {
    std::int64_t sum = 0;
    for (const Polygon& face : faces)
      if (face.size() == 3) sum += bisection_count(face, edge, 0);
    return sum;
  };
  double area = 0;
  for (const Polygon& face : faces)
    if (!face.empty()) area += area_vector(face).norm();
  const auto [fine, coarse] =
      edges_around(std::sqrt(area / static_cast<double>(count)), count,
                   [&](double edge) { return chains.count(cells_for(chains, edge)) + triangle_count(edge); });
  // Where lengths are equal but for rounding, their steps are one.
  const double edge = chains.count(cells_for(chains, fine)) + triangle_count(fine) == count ? fine : coarse;
  std::vector<std::int64_t> cells = cells_for(chains, edge);
  fill_up(chains, cells, edge, count - triangle_count(edge));
  ConformingCells result{{}, edge};
  for (std::size_t f = 0; f < faces.size(); ++f)
    result.sizes.push_back(faces[f].size() == 4 ? chains.grid_size_of(f, cells) : GridSize{});
  return result;
}

}  // namespace radiosity

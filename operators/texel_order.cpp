#include "operators/texel_order.hpp"

#include "compression/row_order.hpp"
#include "factorizations/halving_order.hpp"
#include "foundation/random.hpp"
#include "operators/patch_planes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace radiosity {
namespace {

std::vector<Index> in_sequence(Index n) {
  std::vector<Index> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

/// Fisher and Yates.
std::vector<Index> shuffled(Index n, std::int64_t seed) {
  std::vector<Index> order = in_sequence(n);
  RandomStream random(static_cast<std::uint64_t>(seed));
  for (std::size_t left = order.size(); left > 1; --left)
    std::swap(order[left - 1], order[random.below(left)]);
  return order;
}

std::vector<Index> along_planes(const PatchMesh& mesh) {
  std::vector<Index> order;
  for (const PlacedSet& plane : patch_planes(mesh)) {
    Eigen::MatrixXd places = plane.places;
    if (std::isfinite(plane.aspect)) places.row(0) *= plane.aspect;
    for (const Index item : halving_order(places))
      order.push_back(plane.items[static_cast<std::size_t>(item)]);
  }
  return order;
}

/// first[second[p]] at place p.
std::vector<Index> composed(const std::vector<Index>& first, const std::vector<Index>& second) {
  std::vector<Index> order;
  order.reserve(second.size());
  for (const Index place : second) order.push_back(first[static_cast<std::size_t>(place)]);
  return order;
}

std::vector<Index> greedily(const Eigen::MatrixXd& distances, const std::vector<Index>& start) {
  return composed(start, greedy_order(distances(start, start)));
}

Eigen::MatrixXd column_distances(std::span<const CodeMatrix> codes) {
  std::vector<CodeMatrix> transposed;
  for (const CodeMatrix& channel : codes) transposed.emplace_back(channel.transpose());
  return squared_row_distances(transposed);
}

std::vector<Index> searched(const std::string& reorder, std::span<const CodeMatrix> codes,
                            const std::vector<Index>& start) {
  const Eigen::MatrixXd distances = squared_row_distances(codes);
  std::vector<Index> by_rows = greedily(distances, start);
  if (reorder == "rows") return by_rows;
  if (reorder == "2opt") return two_opt_order(distances, by_rows);
  return greedily(column_distances(codes), by_rows);
}

}  // namespace

TexelOrderChoice TexelOrderChoice::take(Spec& spec) {
  TexelOrderChoice choice;
  choice.reorder = spec.choice("reorder", choice.reorder, {"none", "morton", "rows", "both", "2opt"});
  choice.start = spec.choice("start", choice.start, {"face", "random"});
  if (choice.start == "random") choice.seed = spec.integer("seed", choice.seed, 0, std::int64_t{1} << 53);
  return choice;
}

std::string TexelOrderChoice::text() const {
  const std::string from = start == "face" ? "" : fmt::format(",start={},seed={}", start, seed);
  return "reorder=" + reorder + from;
}

TexelOrder make_texel_order(const TexelOrderChoice& choice, const PatchMesh& mesh) {
  const Index n = mesh.patch_count();
  std::vector<Index> start = choice.start == "random" ? shuffled(n, choice.seed) : in_sequence(n);
  if (choice.reorder == "morton") start = along_planes(mesh);
  if (choice.reorder == "none" || choice.reorder == "morton" || n == 0)
    return [start](std::span<const CodeMatrix>) { return start; };
  return [start, reorder = choice.reorder](std::span<const CodeMatrix> codes) {
    return searched(reorder, codes, start);
  };
}

}  // namespace radiosity

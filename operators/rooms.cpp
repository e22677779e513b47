#include "operators/rooms.hpp"

#include "factorizations/leading_eigenpairs.hpp"
#include "factorizations/spectral_clusters.hpp"
#include "foundation/error.hpp"
#include "kernels/products.hpp"
#include "operators/patch_coordinates.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {

namespace {

constexpr double weakly_coupled = 0.8;  // energy that a mode of a room keeps a bounce, at least
constexpr Index most_rooms = 64;

/// The room of each patch in `live`, from the leading eigenvectors of D K D, D = diag(row sums)^{-1/2}: F
/// with rows scaled to 1 is similar to it.
std::vector<int> room_of_live_patch(const SymmetricTiles<double>& kernel, const Eigen::VectorXd& row_sums,
                                    const std::vector<Index>& live) {
  const Eigen::VectorXd root = row_sums(live).cwiseSqrt();
  const BlockProduct product = [&](const Eigen::MatrixXd& X) {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(kernel.size(), X.cols());
    Eigen::MatrixXd image(kernel.size(), X.cols());
    all(live, Eigen::all) = root.cwiseInverse().asDiagonal() * X;
    multiply(kernel, all, image);
    return Eigen::MatrixXd(root.cwiseInverse().asDiagonal() * image(live, Eigen::all));
  };
  EigenpairOptions options;
  options.wanted_value = weakly_coupled;
  options.accuracy = 1e-2;
  options.most = most_rooms;
  options.confidence = 0.99;
  return spectral_clusters(leading_eigenpairs(product, static_cast<Index>(live.size()), options).vectors);
}

void require_kernel_for_rooms(const FormFactors& form_factors) {
  if (!form_factors.symmetric())
    fail<UsageError>(
        "rooms are found in the symmetric kernel, which form factors by '{}' do not have: use --form-factors "
        "accurate or one-ray",
        form_factors.quality.method);
}

void count_rooms(Rooms& rooms) {
  rooms.count = 0;
  for (const int room : rooms.of_patch) rooms.count = std::max(rooms.count, room + 1);
}

struct PatchSet {
  std::vector<Index> patches;
  double area = 0;
};

PatchSet patch_set(std::vector<Index> patches, const Eigen::VectorXd& area) {
  const double sum = area(patches).sum();
  return {std::move(patches), sum};
}

/// Halves a set across the coordinate in which it extends most.
std::pair<PatchSet, PatchSet> halve(PatchSet set, const Eigen::MatrixXd& coordinates,
                                    const Eigen::VectorXd& area) {
  const Eigen::MatrixXd own = coordinates(Eigen::all, set.patches);
  Index axis = 0;
  (own.rowwise().maxCoeff() - own.rowwise().minCoeff()).maxCoeff(&axis);
  std::stable_sort(set.patches.begin(), set.patches.end(),
                   [&](Index a, Index b) { return coordinates(axis, a) < coordinates(axis, b); });
  const auto middle = set.patches.begin() + static_cast<std::ptrdiff_t>(set.patches.size() / 2);
  return {patch_set({set.patches.begin(), middle}, area), patch_set({middle, set.patches.end()}, area)};
}

}  // namespace

Eigen::MatrixXd Rooms::indicators(const Eigen::VectorXd& root_area) const {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(root_area.size(), count);
  for (Index i = 0; i < root_area.size(); ++i) {
    const int room = of_patch[static_cast<std::size_t>(i)];
    if (room >= 0) columns(i, room) = root_area[i];
  }
  for (Index room = 0; room < count; ++room) {
    const double norm = columns.col(room).norm();
    if (norm > 0) columns.col(room) /= norm;
  }
  return columns;
}

Rooms find_rooms(const FormFactors& form_factors) {
  require_kernel_for_rooms(form_factors);
  const Index n = form_factors.patch_count();
  Rooms rooms;
  rooms.of_patch.assign(static_cast<std::size_t>(n), -1);
  const Eigen::VectorXd row_sums = form_factors.row_sums();
  std::vector<Index> live;
  for (Index i = 0; i < n; ++i)
    if (row_sums[i] > 0) live.push_back(i);
  if (live.empty()) return rooms;
  const std::vector<int> found = room_of_live_patch(*form_factors.kernel, row_sums, live);
  for (std::size_t k = 0; k < live.size(); ++k) rooms.of_patch[static_cast<std::size_t>(live[k])] = found[k];
  count_rooms(rooms);
  return rooms;
}

Rooms rooms_of_groups(const FormFactors& form_factors) {
  Rooms rooms;
  const Eigen::VectorXd row_sums = form_factors.row_sums();
  std::vector<int> number;
  for (Index i = 0; i < form_factors.patch_count(); ++i) {
    const Patch& patch = form_factors.mesh->patches[static_cast<std::size_t>(i)];
    const auto group = static_cast<std::size_t>(patch.group);
    if (number.size() <= group) number.resize(group + 1, -1);
    if (row_sums[i] > 0 && number[group] < 0) number[group] = rooms.count++;
    rooms.of_patch.push_back(row_sums[i] > 0 ? number[group] : -1);
  }
  return rooms;
}

Rooms divide_rooms(const FormFactors& form_factors, const Rooms& rooms, int count) {
  const Index n = form_factors.patch_count();
  const Eigen::VectorXd& area = form_factors.mesh->area;
  const Eigen::MatrixXd coordinates = patch_coordinates(*form_factors.mesh);
  std::vector<std::vector<Index>> members(static_cast<std::size_t>(rooms.count));
  for (Index i = 0; i < n; ++i) {
    const int room = rooms.of_patch[static_cast<std::size_t>(i)];
    if (room >= 0) members[static_cast<std::size_t>(room)].push_back(i);
  }
  std::vector<PatchSet> sets;
  sets.reserve(static_cast<std::size_t>(std::max(count, rooms.count)));
  for (std::vector<Index>& patches : members) sets.push_back(patch_set(std::move(patches), area));
  while (static_cast<int>(sets.size()) < count) {
    const auto largest = std::max_element(sets.begin(), sets.end(), [](const PatchSet& a, const PatchSet& b) {
      return (a.patches.size() > 1 ? a.area : 0) < (b.patches.size() > 1 ? b.area : 0);
    });
    if (largest == sets.end() || largest->patches.size() < 2) break;
    auto [first, second] = halve(std::move(*largest), coordinates, area);
    *largest = std::move(first);
    sets.push_back(std::move(second));
  }
  Rooms divided;
  divided.of_patch.assign(static_cast<std::size_t>(n), -1);
  divided.count = static_cast<int>(sets.size());
  for (std::size_t set = 0; set < sets.size(); ++set)
    for (const Index i : sets[set].patches)
      divided.of_patch[static_cast<std::size_t>(i)] = static_cast<int>(set);
  return divided;
}

}  // namespace radiosity

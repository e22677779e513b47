#include "scene/voxel_quads.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <span>

namespace radiosity {
namespace {

// Fragments fill a rectangle if this part of it is missing at most.
constexpr double kFull = 1e-6;
// The least side of a rectangle, relative to its cell.
constexpr double kLeastSide = 1e-6;
// Quads that face each other nearer than this, relative to their cell, are one sheet: where the surfaces that
// they stand for lie among each other, and in any case.
constexpr double kInvertedSheet = 0.1;
constexpr double kClosedGap = 1e-3;
// Slopes below this are the rounding of a level surface.
constexpr double kLevel = 1e-6;

/// Sums over the fragments of one quad.
struct VoxelSums {
  std::uint64_t cell = 0;
  int direction = 0;
  double area = 0;
  double projected = 0;                   // along the direction
  Vector3 moment = Vector3::Zero();       // area times centroid
  Vector3 area_normal = Vector3::Zero();  // area times normal
  Eigen::AlignedBox3d extent;
  Eigen::RowVectorXd reflected, power;
  std::map<int, double> groups;

  /// Area-weighted, along the direction.
  double offset() const { return moment[axis_of(direction)] / area; }
  /// How far the mean plane rises along the axis for each step along another one.
  double slope(int other) const {
    const double slope = -area_normal[other] / area_normal[axis_of(direction)];
    return std::abs(slope) > kLevel ? slope : 0.0;
  }
  /// Makes the mean plane a level one.
  void level() { area_normal = area * sign_of(direction) * Vector3::Unit(axis_of(direction)); }
};

VoxelSums sum_up(const PatchMesh& mesh, const std::vector<VoxelFragment>& fragments,
                 std::span<const std::size_t> members) {
  VoxelSums sums;
  sums.reflected = sums.power = Eigen::RowVectorXd::Zero(mesh.channels());
  sums.cell = fragments[members.front()].cell;
  sums.direction = fragments[members.front()].direction;
  const int axis = axis_of(sums.direction);
  for (const std::size_t member : members) {
    const VoxelFragment& fragment = fragments[member];
    const Vector3 normal = mesh.normal.col(fragment.patch);
    sums.area += fragment.area;
    sums.projected += fragment.area * std::abs(normal[axis]);
    sums.moment += fragment.area * fragment.centroid;
    sums.area_normal += fragment.area * normal;
    sums.extent.extend(fragment.extent);
    sums.reflected += fragment.area * mesh.reflectance.row(fragment.patch);
    sums.power += fragment.area * mesh.emission.row(fragment.patch);
    sums.groups[mesh.patches[static_cast<std::size_t>(fragment.patch)].group] += fragment.area;
  }
  return sums;
}

/// Of the sides of the rectangle around the projection.
double shrinkage(const VoxelSums& sums, int u, int v) {
  const double filled = sums.projected / (sums.extent.sizes()[u] * sums.extent.sizes()[v]);
  return filled < 1 - kFull ? std::sqrt(filled) : 1.0;
}

/// [low, high] scaled about a point in it, but no narrower than `least`.
std::pair<double, double> scaled(double low, double high, double centre, double factor, double least) {
  if (factor != 1) {
    low = centre + factor * (low - centre);
    high = centre + factor * (high - centre);
  }
  const double missing = least - (high - low);
  return missing > 0 ? std::pair(low - missing / 2, high + missing / 2) : std::pair(low, high);
}

/// Puts the two sides of what became a wall with its fronts inside, by averaging, into one level plane.
void close_gap(VoxelSums& positive, VoxelSums& negative, const VoxelGrid& grid) {
  const int axis = axis_of(positive.direction);
  const double gap = negative.offset() - positive.offset();
  const bool interleaved = positive.extent.max()[axis] > negative.extent.min()[axis];
  const double least = (interleaved ? kInvertedSheet : kClosedGap) * grid.cell()[axis];
  if (!(gap > 0) || gap > least) return;
  const double common = (positive.moment[axis] + negative.moment[axis]) / (positive.area + negative.area);
  positive.moment[axis] = common * positive.area;
  negative.moment[axis] = common * negative.area;
  positive.level();
  negative.level();
}

/// How much of the slope of the mean plane, 1 at most, leaves corners that rise so far above its centre
/// within the extent of the fragments.
double kept_slope(const VoxelSums& sums, const Vector3& centre, const std::array<double, 4>& rises) {
  const int axis = axis_of(sums.direction);
  const double highest = *std::max_element(rises.begin(), rises.end());
  const double lowest = *std::min_element(rises.begin(), rises.end());
  double kept = 1;
  if (highest > 0) kept = std::min(kept, std::max(sums.extent.max()[axis] - centre[axis], 0.0) / highest);
  if (lowest < 0) kept = std::min(kept, std::max(centre[axis] - sums.extent.min()[axis], 0.0) / -lowest);
  return kept;
}

/// Moves the corners of a level rectangle about `centre` along the axis into the mean plane.
void tilt(const VoxelSums& sums, const Vector3& centre, Polygon& corners) {
  const int axis = axis_of(sums.direction), u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::array<double, 4> rises{};
  for (std::size_t k = 0; k < 4; ++k)
    rises[k] = sums.slope(u) * (corners[k][u] - centre[u]) + sums.slope(v) * (corners[k][v] - centre[v]);
  const double kept = kept_slope(sums, centre, rises);
  for (std::size_t k = 0; k < 4; ++k) corners[k][axis] += kept * rises[k];
}

Polygon rectangle(VoxelSums& sums, const VoxelGrid& grid) {
  const int axis = axis_of(sums.direction), u = (axis + 1) % 3, v = (axis + 2) % 3;
  for (const int side : {u, v}) {  // what has no width has no area to be compared with
    const double missing = kLeastSide * grid.cell()[side] - sums.extent.sizes()[side];
    if (missing <= 0) continue;
    sums.extent.min()[side] -= missing / 2;
    sums.extent.max()[side] += missing / 2;
  }
  const Vector3 centre = sums.moment / sums.area;
  const double factor = shrinkage(sums, u, v);
  const auto [u_low, u_high] =
      scaled(sums.extent.min()[u], sums.extent.max()[u], centre[u], factor, kLeastSide * grid.cell()[u]);
  const auto [v_low, v_high] =
      scaled(sums.extent.min()[v], sums.extent.max()[v], centre[v], factor, kLeastSide * grid.cell()[v]);
  const auto corner = [&](double at_u, double at_v) {
    Vector3 point = centre;
    point[u] = at_u;
    point[v] = at_v;
    return point;
  };
  Polygon corners = {corner(u_low, v_low), corner(u_high, v_low), corner(u_high, v_high),
                     corner(u_low, v_high)};
  tilt(sums, centre, corners);
  if (sign_of(sums.direction) < 0) std::reverse(corners.begin(), corners.end());
  return corners;
}

VoxelQuad make_quad(VoxelSums& sums, const VoxelGrid& grid) {
  VoxelQuad quad;
  quad.corners = rectangle(sums, grid);
  quad.reflectance = (sums.reflected / sums.area).cwiseMin(1);  // a mean of ones may be rounded up
  quad.emission = sums.power / area_vector(quad.corners).norm();
  quad.group = std::max_element(sums.groups.begin(), sums.groups.end(), [](const auto& a, const auto& b) {
                 return a.second < b.second;
               })->first;
  quad.source_area = sums.area;
  return quad;
}

}  // namespace

std::vector<VoxelQuad> voxel_quads(const PatchMesh& mesh, const VoxelGrid& grid,
                                   const std::vector<VoxelFragment>& fragments) {
  std::vector<std::size_t> order(fragments.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t member) { return quad_key(fragments[member]); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  std::vector<VoxelSums> sums;
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && key(order[end]) == key(order[begin])) ++end;
    sums.push_back(sum_up(mesh, fragments, {order.data() + begin, end - begin}));
  }
  for (std::size_t k = 1; k < sums.size(); ++k)
    if (sums[k - 1].cell == sums[k].cell && axis_of(sums[k - 1].direction) == axis_of(sums[k].direction))
      close_gap(sums[k - 1], sums[k], grid);
  std::vector<VoxelQuad> quads;
  quads.reserve(sums.size());
  for (VoxelSums& each : sums) quads.push_back(make_quad(each, grid));
  return quads;
}

Index count_quads(const std::vector<VoxelFragment>& fragments) {
  std::vector<std::uint64_t> keys;
  keys.reserve(fragments.size());
  for (const VoxelFragment& fragment : fragments) keys.push_back(quad_key(fragment));
  std::sort(keys.begin(), keys.end());
  return std::unique(keys.begin(), keys.end()) - keys.begin();
}

}  // namespace radiosity

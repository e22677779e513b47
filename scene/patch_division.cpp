#include "scene/patch_division.hpp"

#include "foundation/error.hpp"
#include "scene/conforming_cells.hpp"
#include "scene/face_subdivision.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiosity {
namespace {

constexpr double kMostPatches = 5e7;  // more would not fit in memory, and is a slip of the keyboard

constexpr std::ptrdiff_t kFewCovered = 64;

class FaceDivider {
 public:
  FaceDivider(const Scene& scene, const std::vector<bool>& used, const Covers& covers)
      : covers_(covers), tolerance_(contact_tolerance(scene)), polygons_(scene.faces.size()) {
    for (std::size_t f = 0; f < polygons_.size(); ++f) {
      if (!used[f]) continue;
      for (int k = 0; k < scene.faces[f].corner_count; ++k)
        polygons_[f].push_back(corner(scene, scene.faces[f], k));
      only_triangles_ &= polygons_[f].size() == 3;
      area_ += area_vector(polygons_[f]).norm();
      ++face_count_;
    }
    const auto covered =
        std::count_if(covers.begin(), covers.end(), [](const auto& list) { return !list.empty(); });
    few_covered_ = covered <= kFewCovered;
  }

  Index face_count() const { return face_count_; }
  bool only_triangles() const { return only_triangles_; }

  Division undivided() {
    Division result = empty();
    for (std::size_t f = 0; f < polygons_.size(); ++f)
      if (!polygons_[f].empty()) add(result, f, {polygons_[f]});
    return result;
  }

  Division by_edge(double edge, int passes) {
    check_size(2 * area_ / (edge * edge), edge);
    Division result = empty();
    for (std::size_t f = 0; f < polygons_.size(); ++f) add(result, f, cells(f, edge, passes));
    return result;
  }

  /// Every quad as an m x m grid.
  Division squares(Index m) {
    Division result = empty();
    for (std::size_t f = 0; f < polygons_.size(); ++f) {
      if (polygons_[f].size() == 4) add(result, f, grid(polygons_[f], {m, m}));
      if (polygons_[f].size() == 3) add(result, f, {polygons_[f]});
    }
    return result;
  }

  Division by_count(Index count) {
    check_size(static_cast<double>(count), 0);
    if (only_triangles_) return triangles_by_count(count);
    return by_edge(edge_for(count), 0);
  }

  /// Neighbours are cut alike.
  Division conforming_by_count(Index count) {
    check_size(static_cast<double>(count), 0);
    const ConformingCells conforming = conforming_cells(polygons_, count);
    Division result = empty();
    for (std::size_t f = 0; f < polygons_.size(); ++f)
      if (polygons_[f].size() == 4)
        add(result, f, grid(polygons_[f], conforming.sizes[f]));
      else
        add(result, f, cells(f, conforming.edge, 0));
    return result;
  }

 private:
  Division empty() const { return {std::vector<std::vector<Polygon>>(polygons_.size()), 0}; }

  static void check_size(double patches, double edge) {
    if (patches <= kMostPatches) return;
    if (edge > 0)
      fail<UsageError>("an edge length of {} would give about {:.3g} patches; the most is {:.0e}", edge,
                       patches, kMostPatches);
    fail<UsageError>("{:.0f} patches are too many; the most is {:.0e}", patches, kMostPatches);
  }

  std::vector<Polygon> cells(std::size_t f, double edge, int passes) const {
    if (polygons_[f].empty()) return {};
    if (polygons_[f].size() == 3) return bisect(polygons_[f], edge, passes);
    return grid(polygons_[f], grid_size(polygons_[f], edge));
  }

  void add(Division& result, std::size_t f, std::vector<Polygon> face_cells) const {
    if (f >= covers_.size() || covers_[f].empty()) {
      result.parts[f] = std::move(face_cells);
      return;
    }
    const Vector3 normal = area_vector(polygons_[f]).normalized();
    for (const Polygon& cell : face_cells) {
      const double least = 1e-9 * area_vector(cell).norm();
      for (const Polygon& rest : uncovered(cell, covers_[f], normal, tolerance_))
        for (Polygon& patch : triangles_and_quads(rest))
          if (area_vector(patch).norm() > least)
            result.parts[f].push_back(std::move(patch));
          else
            ++result.dropped_pieces;
    }
  }

  Index count_for(double edge) const {
    Index count = 0;
    for (std::size_t f = 0; f < polygons_.size(); ++f) {
      if (polygons_[f].empty()) continue;
      if (few_covered_ && f < covers_.size() && !covers_[f].empty()) {
        Division one = empty();
        add(one, f, cells(f, edge, 0));
        count += static_cast<Index>(one.parts[f].size());
      } else if (polygons_[f].size() == 3) {
        count += bisection_count(polygons_[f], edge, 0);
      } else {
        const GridSize size = grid_size(polygons_[f], edge);
        count += size.rows * size.columns;
      }
    }
    return count;
  }

  /// The longest edge allowed for which the number of patches is nearest to `count`.
  double edge_for(Index count) const {
    const auto [fine, coarse] = edges_around(std::sqrt(area_ / static_cast<double>(count)), count,
                                             [this](double edge) { return count_for(edge); });
    return count_for(fine) - count <= count - count_for(coarse) ? fine : coarse;
  }

  /// Contacts change the number by what they remove and cut, which is known only afterwards: a few rounds
  /// come close.
  Division triangles_by_count(Index count) const {
    std::vector<Polygon> triangles;
    for (const Polygon& polygon : polygons_)
      if (!polygon.empty()) triangles.push_back(polygon);
    Index wanted = count;
    for (int round = 0;; ++round) {
      std::vector<std::vector<Polygon>> parts = bisect_to_count(triangles, wanted);
      Division result = empty();
      auto next = parts.begin();
      Index reached = 0;
      for (std::size_t f = 0; f < polygons_.size(); ++f) {
        if (polygons_[f].empty()) continue;
        add(result, f, std::move(*next++));
        reached += static_cast<Index>(result.parts[f].size());
      }
      if (reached == count || round == 3) return result;
      wanted = std::max<Index>(wanted + count - reached, static_cast<Index>(triangles.size()));
    }
  }

  const Covers& covers_;
  double tolerance_;
  std::vector<Polygon> polygons_;  // of each face; empty where unused
  bool only_triangles_ = true;
  bool few_covered_ = true;  // so that a search for the number of patches can afford to cut them
  double area_ = 0;
  Index face_count_ = 0;
};

void check(const Subdivision& wanted, Index faces) {
  if (wanted.patches != 0 && wanted.edge != 0)
    fail<UsageError>("--patches and --edge exclude each other; give one of them");
  if (wanted.patches < 0)
    fail<UsageError>("{} patches are not possible; give a positive number", wanted.patches);
  if (!(wanted.edge >= 0) || !std::isfinite(wanted.edge))
    fail<UsageError>("an edge length of {} is not possible; give a positive number", wanted.edge);
  if (wanted.passes < 0 || (wanted.passes > 0 && wanted.edge == 0))
    fail<UsageError>(
        "passes limit the bisection to an edge length; give that too, and a positive number of passes");
  if (wanted.patches > 0 && wanted.patches < faces)
    fail<UsageError>("{} patches are fewer than the scene's {} faces; ask for at least {}", wanted.patches,
                     faces, faces);
}

}  // namespace

Division divide_faces(const Scene& scene, const std::vector<bool>& used, const Covers& covers,
                      const Subdivision& subdivision) {
  FaceDivider divider(scene, used, covers);
  const Index faces = divider.face_count();
  check(subdivision, faces);
  if (subdivision.edge > 0) return divider.by_edge(subdivision.edge, subdivision.passes);
  if (subdivision.patches == 0) return divider.undivided();
  if (scene.conforming && !divider.only_triangles()) return divider.conforming_by_count(subdivision.patches);
  if (!scene.box_like) return divider.by_count(subdivision.patches);
  const double side = std::sqrt(static_cast<double>(subdivision.patches) / static_cast<double>(faces));
  return divider.squares(std::max<Index>(1, std::llround(side)));
}

}  // namespace radiosity

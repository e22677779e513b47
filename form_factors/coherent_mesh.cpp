#include "form_factors/coherent_mesh.hpp"

#include "form_factors/scene_views.hpp"
#include "scene/patch_division.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <utility>
#include <vector>

namespace radiosity {
namespace {

/// A patch on its way.
struct Candidate {
  double incoherence = 0;  ///< times area; 0 for patches that are coherent or may not be cut
  std::size_t number = 0;  ///< in the order in which patches were made
  std::size_t face = 0;
  Polygon polygon;
  std::vector<Index> elements;
  bool operator<(const Candidate& other) const {
    return incoherence != other.incoherence ? incoherence < other.incoherence : number > other.number;
  }
};

/// Where along an edge to cut: in the gap between two rows of elements that is nearest to its middle.
double place_of_cut(const PatchMesh& elements, const Candidate& patch, std::size_t edge) {
  const std::vector<double> gaps = gaps_along(elements, patch.elements, patch.polygon, edge);
  const auto nearest = std::min_element(
      gaps.begin(), gaps.end(), [](double a, double b) { return std::fabs(a - 0.5) < std::fabs(b - 0.5); });
  return nearest == gaps.end() ? 0.5 : *nearest;
}

/// Algorithm 1 from given patches.
class TopDownSplitting {
 public:
  TopDownSplitting(const PatchMesh& elements, const CoarseMesh& start, const SceneViews& views,
                   const CoherentMeshOptions& options)
      : elements_(elements), views_(views), options_(options) {
    const PatchMesh& patches = start.patches;
    std::vector<std::vector<Index>> members = elements_by_patch(start);
    for (std::size_t p = 0; p < members.size(); ++p)
      add(static_cast<std::size_t>(patches.patches[p].face), polygon_of(patches, static_cast<Index>(p)),
          std::move(members[p]));
  }

  void split_until(Index count) {
    while (static_cast<Index>(patches_.size()) < count && !patches_.empty() && patches_.top().incoherence > 0)
      split();
  }

  /// The sum of area times incoherence.
  double incoherence() const {
    double sum = 0;
    for (auto rest = patches_; !rest.empty(); rest.pop()) sum += rest.top().incoherence;
    return sum;
  }

  CoarseMesh mesh() const {
    std::vector<Candidate> all;
    all.reserve(patches_.size());
    for (auto rest = patches_; !rest.empty(); rest.pop()) all.push_back(rest.top());
    std::sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
      return std::pair(a.face, a.number) < std::pair(b.face, b.number);
    });
    std::vector<std::vector<Polygon>> parts(elements_.scene->faces.size());
    std::vector<int> patch_of_element(elements_.patches.size());
    for (std::size_t p = 0; p < all.size(); ++p) {
      for (const Index e : all[p].elements)
        patch_of_element[static_cast<std::size_t>(e)] = static_cast<int>(p);
      parts[all[p].face].push_back(all[p].polygon);
    }
    return {mesh_of_parts(elements_, std::move(parts)), std::move(patch_of_element)};
  }

 private:
  void split() {
    Candidate worst = patches_.top();
    patches_.pop();
    auto [first, second] = cut(worst);
    const Vector3 normal = area_vector(worst.polygon).normalized();
    constexpr double slack = 1e-9;
    std::vector<Index> in_first, in_second;
    for (const Index e : worst.elements)
      (contains(first, elements_.centroid.col(e), normal, slack) ? in_first : in_second).push_back(e);
    // A part without an element is none: the other then stands for the whole.
    if (in_first.empty() || in_second.empty()) {
      worst.incoherence = 0;
      patches_.push(std::move(worst));
      return;
    }
    add(worst.face, std::move(first), std::move(in_first));
    add(worst.face, std::move(second), std::move(in_second));
  }

  std::pair<Polygon, Polygon> cut(const Candidate& patch) const {
    if (patch.polygon.size() == 3) return halve_triangle(patch.polygon);
    const std::size_t edge = longer_edges(patch.polygon);
    return cut_quad(patch.polygon, edge, place_of_cut(elements_, patch, edge));
  }

  void add(std::size_t face, Polygon polygon, std::vector<Index> elements) {
    Candidate patch{0, made_++, face, std::move(polygon), std::move(elements)};
    const double area = area_vector(patch.polygon).norm();
    if (patch.elements.size() > 1 && area > options_.least_area) {
      const double incoherence = views_.incoherence(patch.polygon);
      if (incoherence > options_.threshold) patch.incoherence = area * incoherence;
    }
    patches_.push(std::move(patch));
  }

  const PatchMesh& elements_;
  const SceneViews& views_;
  CoherentMeshOptions options_;
  std::size_t made_ = 0;
  std::priority_queue<Candidate> patches_;
};

/// The faces, and uniform meshes of up to k patches.
std::vector<CoarseMesh> starts(const PatchMesh& elements, Index k, Assignment assignment) {
  std::vector<CoarseMesh> result;
  const PatchMesh coarsest = coarsest_patches(elements);
  if (coarsest.patch_count() > k) return result;
  result.push_back(assign_elements(elements, coarsest, assignment));
  for (const Index quarters : {1, 2, 3, 4}) {
    std::optional<CoarseMesh> uniform = uniform_coarse_mesh(elements, k * quarters / 4, assignment);
    if (uniform && uniform->patches.patch_count() > result.back().patches.patch_count())
      result.push_back(std::move(*uniform));
  }
  return result;
}

}  // namespace

std::optional<CoarseMesh> coherent_coarse_mesh(const PatchMesh& elements, Index k, Assignment assignment,
                                               const CoherentMeshOptions& options) {
  if (!elements.scene || elements.patch_count() <= k) return uniform_coarse_mesh(elements, k, assignment);
  const std::vector<CoarseMesh> all_starts = starts(elements, k, assignment);
  if (all_starts.empty()) return std::nullopt;
  const SceneViews views(all_starts.front().patches, options.directions, options.seed);
  std::optional<CoarseMesh> best;
  double least = 0;
  for (const CoarseMesh& start : all_starts) {
    TopDownSplitting splitting(elements, start, views, options);
    splitting.split_until(k);
    const double incoherence = splitting.incoherence();
    if (best && incoherence >= least) continue;
    least = incoherence;
    best = splitting.mesh();
  }
  return best;
}

}  // namespace radiosity

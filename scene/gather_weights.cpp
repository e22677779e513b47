#include "scene/gather_weights.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

// Cosines and weights below this are rounding.
constexpr double kNothing = 1e-9;

double agreement(const Vector3& normal, const PatchMesh& mesh, Index patch) {
  const double cosine = normal.dot(mesh.normal.col(patch));
  return cosine > kNothing ? cosine * cosine : 0.0;
}

}  // namespace

/// The four largest weights so far; of equal ones the earlier patches.
class GatherSearch::Best {
 public:
  void offer(Index patch, double weight) {
    if (!(weight > kNothing * result_.weights[0])) return;
    std::size_t place = count_;
    while (place > 0 && precedes(weight, patch, place - 1)) --place;
    if (place == 4) return;
    count_ = std::min<std::size_t>(count_ + 1, 4);
    for (std::size_t k = count_ - 1; k > place; --k) {
      result_.weights[k] = result_.weights[k - 1];
      result_.patches[k] = result_.patches[k - 1];
    }
    result_.weights[place] = weight;
    result_.patches[place] = patch;
  }

  double largest() const { return result_.weights[0]; }

  GatherWeights normalized() const {
    GatherWeights result = result_;
    double sum = 0;
    for (const double weight : result.weights) sum += weight;
    for (double& weight : result.weights) weight /= sum;
    for (std::size_t k = count_; k < 4; ++k) result.patches[k] = result.patches[0];
    return result;
  }

 private:
  bool precedes(double weight, Index patch, std::size_t k) const {
    return weight != result_.weights[k] ? weight > result_.weights[k] : patch < result_.patches[k];
  }

  GatherWeights result_;
  std::size_t count_ = 0;
};

Eigen::RowVectorXd GatherWeights::mean(const Eigen::MatrixXd& field) const {
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(field.cols());
  for (std::size_t k = 0; k < 4; ++k) sum += weights[k] * field.row(patches[k]);
  return sum;
}

GatherSearch::GatherSearch(const PatchMesh& mesh, const VoxelGrid& grid) : mesh_(mesh), grid_(grid) {
  patches_.reserve(mesh.patches.size());
  for (Index i = 0; i < mesh.patch_count(); ++i)
    patches_.emplace_back(grid.number(grid.cell_of(mesh.centroid.col(i))), i);
  std::sort(patches_.begin(), patches_.end());
}

void GatherSearch::add_near(const Vector3& point, const Vector3& normal, Best& best) const {
  const Eigen::Array3i cell = grid_.cell_of(point);
  const Eigen::Array3i low = (cell - 1).max(0), high = (cell + 1).min(grid_.counts() - 1);
  for (int z = low.z(); z <= high.z(); ++z)
    for (int y = low.y(); y <= high.y(); ++y) {
      const std::uint64_t first = grid_.number({low.x(), y, z}), last = grid_.number({high.x(), y, z});
      auto found = std::lower_bound(patches_.begin(), patches_.end(), std::pair(first, Index{0}));
      for (; found != patches_.end() && found->first <= last; ++found) {
        const Index patch = found->second;
        const Vector3 away = (point - mesh_.centroid.col(patch)).cwiseAbs();
        const Eigen::Array3d tent = 1 - away.array() / grid_.cell().array();
        if (tent.minCoeff() > 0) best.offer(patch, tent.prod() * agreement(normal, mesh_, patch));
      }
    }
}

void GatherSearch::add_far(const Vector3& point, const Vector3& normal, Best& best) const {
  const double cell = grid_.cell().squaredNorm();
  for (Index patch = 0; patch < mesh_.patch_count(); ++patch) {
    const double distance = (point - mesh_.centroid.col(patch)).squaredNorm();
    best.offer(patch, agreement(normal, mesh_, patch) / (1 + distance / cell));
  }
}

GatherWeights GatherSearch::at(const Vector3& point, const Vector3& normal) const {
  Best best;
  add_near(point, normal, best);
  if (!(best.largest() > kNothing)) {
    best = {};
    add_far(point, normal, best);
  }
  if (!(best.largest() > 0))
    fail("every patch of the simplified scene faces away from the point ({:.6g}, {:.6g}, {:.6g})", point.x(),
         point.y(), point.z());
  return best.normalized();
}

}  // namespace radiosity

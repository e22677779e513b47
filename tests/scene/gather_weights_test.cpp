#include "foundation/error.hpp"
#include "scene/built_in.hpp"
#include "scene/gather_weights.hpp"
#include "scene/light_transfer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace radiosity {
namespace {

/// A different value on every patch.
Eigen::MatrixXd uneven_field(Index n) {
  return 1 + Eigen::ArrayXd::LinSpaced(n, 0, 50).sin().abs();
}

SimplifiedScene simplified_scene(const PatchMesh& original) {
  return simplify_to_voxels(original, 250);
}

/// The mean of the field over the four largest weights of all patches: slow and plain. Without normals it is
/// the broken variant that takes the other side of a wall.
double plain_mean(const SimplifiedScene& simplified, const Vector3& point, const Vector3& normal,
                  const Eigen::MatrixXd& field, bool with_normals = true) {
  const PatchMesh& mesh = *simplified.mesh;
  std::vector<std::pair<double, Index>> weights;
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    double weight = with_normals ? std::pow(std::max(0.0, normal.dot(mesh.normal.col(i))), 2) : 1;
    for (int axis = 0; axis < 3; ++axis)
      weight *=
          std::max(0.0, 1 - std::abs(point[axis] - mesh.centroid(axis, i)) / simplified.grid.cell()[axis]);
    weights.emplace_back(-weight, i);
  }
  std::partial_sort(weights.begin(), weights.begin() + 4, weights.end());
  double sum = 0, total = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    sum -= weights[k].first * field(weights[k].second, 0);
    total -= weights[k].first;
  }
  return sum / total;
}

class GatherWeightsOf : public testing::TestWithParam<const char*> {
 protected:
  PatchMesh original_ = make_patches(built_in_scene(GetParam()));
  SimplifiedScene simplified_ = simplified_scene(original_);
};

TEST_P(GatherWeightsOf, ArePositiveSumUpToOneAndFaceTheSameWay) {
  const GatherSearch search(*simplified_.mesh, simplified_.grid);
  for (Index i = 0; i < original_.patch_count(); ++i)
    for (int k = 0; k < original_.patches[static_cast<std::size_t>(i)].corner_count; ++k) {
      const GatherWeights found = search.at(original_.corner(i, k), original_.normal.col(i));
      double sum = 0;
      for (std::size_t m = 0; m < 4; ++m) {
        EXPECT_GE(found.weights[m], 0);
        sum += found.weights[m];
        EXPECT_GT(simplified_.mesh->normal.col(found.patches[m]).dot(original_.normal.col(i)), 0);
      }
      EXPECT_NEAR(sum, 1, 1e-15);
    }
}

TEST_P(GatherWeightsOf, KeepConstantsAndTheRangeOfTheFour) {
  const Index n = simplified_.mesh->patch_count();
  const Eigen::MatrixXd ones = pull_back_to_patches(simplified_, original_, Eigen::MatrixXd::Ones(n, 3));
  EXPECT_LT((ones.array() - 1).abs().maxCoeff(), 1e-14);
  const Eigen::MatrixXd field = uneven_field(n);
  const GatherSearch search(*simplified_.mesh, simplified_.grid);
  for (Index i = 0; i < original_.patch_count(); ++i) {
    const GatherWeights found = search.at(original_.centroid.col(i), original_.normal.col(i));
    double low = 1e9, high = 0;
    for (const Index patch : found.patches) {
      low = std::min(low, field(patch, 0));
      high = std::max(high, field(patch, 0));
    }
    EXPECT_GE(found.mean(field)[0], low - 1e-15);
    EXPECT_LE(found.mean(field)[0], high + 1e-15);
  }
  const Eigen::MatrixXd pulled = pull_back_to_patches(simplified_, original_, field);
  EXPECT_GE(pulled.minCoeff(), field.minCoeff() - 1e-14);
  EXPECT_LE(pulled.maxCoeff(), field.maxCoeff() + 1e-14);
}

TEST_P(GatherWeightsOf, AreThoseOfThePlainSearch) {
  const Eigen::MatrixXd field = uneven_field(simplified_.mesh->patch_count());
  const GatherSearch search(*simplified_.mesh, simplified_.grid);
  for (std::size_t f = 0; f < simplified_.fragments.size(); f += 7) {
    const VoxelFragment& fragment = simplified_.fragments[f];
    const Vector3 normal = original_.normal.col(fragment.patch);
    EXPECT_NEAR(search.at(fragment.centroid, normal).mean(field)[0],
                plain_mean(simplified_, fragment.centroid, normal, field), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, GatherWeightsOf,
                         testing::Values("cube", "cornell-box-closed", "sphere-cavity", "clutter"));

TEST(GatherWeights, InterpolateALinearFieldOnAWall) {
  const PatchMesh cube = make_patches(built_in_scene("cube"));
  const SimplifiedScene simplified = simplify_to_voxels(cube, 600);
  const PatchMesh& mesh = *simplified.mesh;
  const Eigen::MatrixXd field = (2 * mesh.centroid.row(0) + 3 * mesh.centroid.row(1)).transpose();
  const GatherSearch search(mesh, simplified.grid);
  for (const double x : {0.05, 0.31, 0.5, 0.77})
    for (const double y : {0.11, 0.4, 0.95}) {
      EXPECT_NEAR(search.at({x, y, 0}, {0, 0, 1}).mean(field)[0], 2 * x + 3 * y, 1e-12);
      EXPECT_NEAR(search.at({x, y, 1}, {0, 0, -1}).mean(field)[0], 2 * x + 3 * y, 1e-12);
    }
}

TEST(GatherWeights, NeverTakeTheOtherSideOfASheet) {
  Scene scene = built_in_scene("facing-plates");
  const PatchMesh plates = make_patches(two_sided(scene));
  const SimplifiedScene simplified = simplify_to_voxels(plates, 64);
  Eigen::MatrixXd field(simplified.mesh->patch_count(), 1);
  for (Index i = 0; i < field.rows(); ++i) {
    int axis = 0;
    simplified.mesh->normal.col(i).cwiseAbs().maxCoeff(&axis);
    field(i, 0) = simplified.mesh->normal(axis, i);
  }
  const Eigen::MatrixXd pulled = pull_back_to_patches(simplified, plates, field);
  for (Index i = 0; i < plates.patch_count(); ++i) {
    const Vector3 normal = plates.normal.col(i);
    EXPECT_NEAR(pulled(i, 0), normal.sum(), 1e-14);
    EXPECT_LT(std::abs(plain_mean(simplified, plates.centroid.col(i), normal, field, false)), 0.9);
  }
}

TEST(GatherWeights, ReachFarWhereNothingIsNear) {
  const PatchMesh cube = make_patches(built_in_scene("cube"));
  const SimplifiedScene simplified = simplify_to_voxels(cube, 600);
  const GatherSearch search(*simplified.mesh, simplified.grid);
  const GatherWeights found = search.at({0.5, 0.5, 0.5}, Vector3::UnitZ());
  for (const Index patch : found.patches) EXPECT_EQ(simplified.mesh->normal(2, patch), 1);
  const PatchMesh plates = make_patches(built_in_scene("wedge"));
  const SimplifiedScene few = simplify_to_voxels(plates, 2);
  const Vector3 away = -(few.mesh->normal.col(0) + few.mesh->normal.col(1)).normalized();
  EXPECT_THROW(GatherSearch(*few.mesh, few.grid).at(Vector3::Zero(), away), Error);
}

TEST(LightTransfer, SumsOverFragmentsHaveAllPowerAndThatOfEachQuad) {
  const PatchMesh original = make_patches(built_in_scene("cornell-box-closed"), {.patches = 200});
  const SimplifiedScene simplified = simplified_scene(original);
  const Eigen::MatrixXd field = uneven_field(original.patch_count());
  const Eigen::MatrixXd sums = sum_over_fragments(simplified, original, field);
  EXPECT_NEAR(sums.sum(), original.area.dot(field.col(0)), 1e-9 * sums.sum());
  const PatchMesh& mesh = *simplified.mesh;
  const Eigen::MatrixXd power = sum_over_fragments(simplified, original, original.emission);
  EXPECT_LT((power - mesh.area.asDiagonal() * mesh.emission).norm(), 1e-9 * power.norm());
  EXPECT_GT((power - mesh.emission).norm(), 1e-3 * power.norm()) << "power is not emission";
  EXPECT_THROW(sum_over_fragments(simplified, original, field.topRows(3)), UsageError);
}

TEST(LightTransfer, AveragesOverLargePatchesAndInterpolatesAtCorners) {
  const PatchMesh cube = make_patches(built_in_scene("cube"));
  const SimplifiedScene simplified = simplify_to_voxels(cube, 600);
  const Eigen::MatrixXd field = simplified.mesh->centroid.row(0).transpose();
  const Eigen::MatrixXd patches = pull_back_to_patches(simplified, cube, field);
  const Eigen::MatrixXd corners = pull_back_to_corners(simplified, cube, field);
  ASSERT_EQ(corners.rows(), 24);
  for (Index i = 0; i < 6; ++i) {
    if (std::abs(cube.normal(0, i)) < 0.5) {
      EXPECT_NEAR(patches(i, 0), 0.5, 1e-12);
    }
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(corners(4 * i + k, 0), cube.corner(i, k).x(), 0.0501);
  }
  EXPECT_THROW(pull_back_to_patches(simplified, cube, Eigen::MatrixXd::Ones(5, 1)), UsageError);
}

}  // namespace
}  // namespace radiosity

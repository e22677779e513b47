#include "form_factors/exact_rooms.hpp"
#include "operators/low_rank_operator.hpp"
#include "operators/operator_registry.hpp"
#include "operators/patch_planes.hpp"
#include "scene/built_in.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace radiosity {
namespace {

const std::vector<std::string> factorizations = {
    "svd:method=dense,",    "svd:method=lanczos,",     "rsvd:",    "qr:",
    "cur:core=projection,", "cur:core=interpolation,", "wavelet:", "dct:"};

/// ||A - T|| / ||T|| in Frobenius's norm, or in the area norm.
double error_of(const std::string& spec, const exact_rooms::Room& room, bool area_norm) {
  const auto transport = cpu_operators().make(spec, exact_rooms::form_factors_of(room));
  Eigen::MatrixXd A(room.size(), room.size());
  transport->apply(Eigen::MatrixXd::Identity(room.size(), room.size()), A);
  Eigen::MatrixXd T = room.transport(0);
  if (area_norm) {
    const Eigen::VectorXd root = room.root_area();
    A = root.asDiagonal() * A * root.cwiseInverse().asDiagonal();
    T = root.asDiagonal() * T * root.cwiseInverse().asDiagonal();
  }
  return (A - T).norm() / T.norm();
}

TEST(LowRankOperators, AreExactAtFullRank) {
  const exact_rooms::Room room = exact_rooms::open_room(40, 3, 1);
  for (const std::string& name : factorizations)
    for (const std::string keys : {"k=40,storage=f64,norm=plain", "k=40,storage=f64,norm=area"})
      EXPECT_LE(error_of(name + keys, room, false), 1e-12) << name << keys;
}

TEST(LowRankOperators, NoneIsBetterThanTheSvd) {
  const exact_rooms::Room room = exact_rooms::closed_room(60, 4, 0.7);
  for (const std::string norm : {"plain", "area"}) {
    const std::string keys = "k=12,storage=f64,norm=" + norm;
    const double best = error_of("svd:" + keys, room, norm == "area");
    EXPECT_GT(best, 1e-2);
    for (const std::string& name : factorizations) {
      const double error = error_of(name + keys, room, norm == "area");
      EXPECT_GE(error, best * (1 - 1e-10)) << name << norm;
      EXPECT_LE(error, 2 * best) << name << norm;
    }
    EXPECT_LE(error_of("cur:core=projection," + keys, room, norm == "area"),
              error_of("cur:core=interpolation," + keys, room, norm == "area"));
  }
}

TEST(LowRankOperators, SayThatTheRankOfTheRoomIsLower) {
  const exact_rooms::Room sphere = exact_rooms::sphere_cavity(30, 5, 0.8);  // F has rank 1
  for (const std::string name : {"qr:", "cur:"}) {
    const auto transport = cpu_operators().make(name + "k=8", exact_rooms::form_factors_of(sphere));
    EXPECT_EQ(dynamic_cast<const LowRankFactors&>(*transport).rank(), 1);
    EXPECT_EQ(transport->remark(), "1 of 8 columns: the others depend on them to rounding");
    EXPECT_LE(error_of(name + "k=8,storage=f64", sphere, false), 1e-13);
  }
  const auto full =
      cpu_operators().make("qr:k=8", exact_rooms::form_factors_of(exact_rooms::open_room(40, 3, 1)));
  EXPECT_EQ(full->remark(), "");
}

PatchMesh mesh_of_scene(const std::string& name, Index patches) {
  return make_patches(built_in_scene(name), {.patches = patches});
}

TEST(PatchPlanes, AreTheFacesOfACubeAsGrids) {
  const PatchMesh cube = mesh_of_scene("cube", 96);
  const std::vector<PlacedSet> planes = patch_planes(cube);
  ASSERT_EQ(planes.size(), 6U);
  for (const PlacedSet& plane : planes) {
    EXPECT_EQ(plane.items.size(), 16U);
    EXPECT_NEAR(plane.aspect, 1, 1e-12);
    EXPECT_NEAR(plane.places.minCoeff(), 0.125, 1e-12);
    EXPECT_NEAR(plane.places.maxCoeff(), 0.875, 1e-12);
    for (const Index patch : plane.items)
      EXPECT_EQ(cube.normal.col(patch), cube.normal.col(plane.items.front()));
  }
  const FunctionFamily functions = cosines(planes, Eigen::VectorXd::Ones(96));
  std::vector<Index> all(96);
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<Index>(k);
  const Eigen::MatrixXd W = functions.columns(all);
  EXPECT_LE((W.transpose() * W - Eigen::MatrixXd::Identity(96, 96)).norm(), 1e-12);
}

TEST(PatchPlanes, HoldEveryPatchOnce) {
  for (const std::string name : {"cornell-box", "rooms:n=2,door=0.3", "flat", "isolated-patch"}) {
    const PatchMesh mesh = mesh_of_scene(name, 150);
    std::vector<int> met(static_cast<std::size_t>(mesh.patch_count()));
    for (const PlacedSet& plane : patch_planes(mesh)) {
      ASSERT_EQ(static_cast<Index>(plane.items.size()), plane.places.cols());
      EXPECT_GT(plane.places.minCoeff(), 0) << name;
      EXPECT_LT(plane.places.maxCoeff(), 1) << name;
      for (const Index patch : plane.items) ++met[static_cast<std::size_t>(patch)];
    }
    EXPECT_EQ(met, std::vector<int>(met.size(), 1)) << name;
  }
}

}  // namespace
}  // namespace radiosity

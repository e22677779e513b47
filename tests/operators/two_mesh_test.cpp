#include "form_factors/exact_rooms.hpp"
#include "foundation/error.hpp"
#include "operators/element_partition.hpp"
#include "operators/operator_registry.hpp"
#include "operators/sparse_v_operator.hpp"
#include "scene/built_in.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace radiosity {
namespace {

FormFactors factors_of(const char* scene, Index patches) {
  SilentMonitor monitor;
  return compute_form_factors(
      std::make_shared<const PatchMesh>(make_patches(built_in_scene(scene), {.patches = patches})), {},
      monitor);
}

Field materialized(const LinearOperator& transport) {
  const Index n = transport.size();
  const Field identity = Field::Identity(n, n);
  Field image(n, n);
  if (transport.channels() == 1) {
    transport.apply(identity, image);
    return image;
  }
  Field X = Field::Zero(n, 3 * n);
  for (Index k = 0; k < n; ++k) X.col(3 * k + 1) = identity.col(k);
  Field Y(n, 3 * n);
  transport.apply(X, Y);
  for (Index k = 0; k < n; ++k) image.col(k) = Y.col(3 * k + 1);
  return image;
}

/// The mean over each patch, weighted by area, n x n.
Eigen::MatrixXd patch_means(const ElementPartition& partition) {
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(partition.elements(), partition.patches());
  for (Index e = 0; e < S.rows(); ++e) S(e, partition.patch_of_element()[static_cast<std::size_t>(e)]) = 1;
  return S * partition.patch_area().cwiseInverse().asDiagonal() * S.transpose() *
         partition.element_area().asDiagonal();
}

ElementPartition partition_of(const FormFactors& F, const std::string& spec) {
  Spec parsed = Spec::parse(spec);
  return choose_partition(F, PartitionChoice::take(parsed)).partition;
}

TEST(TwoMesh, IsFOnPatchMeans) {
  for (const char* scene : {"cube", "clutter"}) {
    const FormFactors F = factors_of(scene, 300);
    for (const std::string mesh : {"uniform", "adaptive"}) {
      const std::string keys = "k=90,mesh=" + mesh;
      const Eigen::MatrixXd P = patch_means(partition_of(F, "2msc:" + keys));
      const Eigen::MatrixXd T =
          F.mesh->reflectance.rightCols(F.mesh->channels() == 3 ? 2 : 1).col(0).asDiagonal() * F.matrix();
      const auto matrix = [&](const std::string& spec) {
        return materialized(*cpu_operators().make(spec, F));
      };
      EXPECT_LE((matrix("2msc:storage=f64," + keys) - T * P).norm(), 1e-12 * T.norm());
      EXPECT_LE((matrix("sparse-v:storage=f64," + keys) - T * P).norm(), 1e-12 * T.norm());
      EXPECT_LE((matrix("2msc:" + keys) - T * P).norm(), 1e-6 * T.norm());
      const Eigen::MatrixXd two_sided = T.rows() == 0 ? T : Eigen::MatrixXd(T);
      const Eigen::VectorXd rho = F.mesh->reflectance.rightCols(F.mesh->channels() == 3 ? 2 : 1).col(0);
      const Eigen::MatrixXd G = F.matrix();
      const Eigen::MatrixXd sides = rho.asDiagonal() * (G * P + P * G - P * G * P);
      EXPECT_LE((matrix("2msc:sides=two,storage=f64," + keys) - sides).norm(), 1e-12 * T.norm());
      // One side is not the other.
      EXPECT_GT((matrix("2msc:storage=f64," + keys) - sides).norm(), 1e-2 * T.norm());
    }
  }
}

TEST(TwoMesh, OnePassOverUIsKProducts) {
  const FormFactors F = factors_of("clutter", 300);
  for (const std::string keys : {"k=60", "k=60,storage=f64", "k=60,mesh=uniform"}) {
    const auto transport = cpu_operators().make("sparse-v:" + keys, F);
    const auto& factors = dynamic_cast<const LowRankFactors&>(*transport);
    const auto between = factors.multiply_between(factors.albedo());
    const auto by_products = factors.LowRankFactors::multiply_between(factors.albedo());
    ASSERT_EQ(between.size(), static_cast<std::size_t>(factors.albedo().cols()));
    for (std::size_t c = 0; c < between.size(); ++c) {
      EXPECT_GT(between[c].norm(), 0);
      EXPECT_LE((between[c] - by_products[c]).norm(), 1e-6 * by_products[c].norm()) << keys;
    }
  }
}

TEST(TwoMesh, WithAsManyPatchesAsElementsIsDense) {
  const FormFactors F = factors_of("cube", 216);
  const Field dense = materialized(*cpu_operators().make("dense", F));
  for (const char* spec : {"2msc:k=216,storage=f64", "sparse-v:k=216,storage=f64",
                           "2msc:k=216,storage=f64,sides=two", "sparse-v:k=1000,storage=f64,mesh=uniform"})
    EXPECT_LE((materialized(*cpu_operators().make(spec, F)) - dense).norm(), 1e-13 * dense.norm()) << spec;
  EXPECT_GT((materialized(*cpu_operators().make("2msc:k=54,storage=f64", F)) - dense).norm(),
            0.1 * dense.norm());
}

TEST(TwoMesh, KeepsRowSums) {
  const FormFactors F = factors_of("cornell-box-closed", 500);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(F.patch_count());
  for (const char* spec : {"2msc:k=100", "sparse-v:k=100,assign=proximity", "2msc:k=100,sides=two"}) {
    const auto transport = cpu_operators().make(spec, F);
    Field Y(F.patch_count(), 3);
    transport->apply(ones.replicate(1, 3), Y);
    for (Index c = 0; c < 3; ++c)
      EXPECT_LE((Y.col(c) - F.mesh->reflectance.col(c)).cwiseAbs().maxCoeff(), 1e-6) << spec;
  }
}

TEST(SparseV, TakesSortedFieldsWithoutItsPermutation) {
  const FormFactors F = factors_of("clutter", 300);
  const auto made = cpu_operators().make("sparse-v:k=90", F);
  const auto& transport = dynamic_cast<const SparseVOperator<float>&>(*made);
  const std::vector<std::int32_t>& order = transport.right_factor().order();
  ASSERT_FALSE(order.empty());
  const Field X = Field::Random(F.patch_count(), 3);
  const Field sorted = X(order, Eigen::all);
  Field C(transport.rank(), 3), sorted_C(transport.rank(), 3);
  transport.multiply_right_transposed(X, C);
  transport.multiply_right_transposed_sorted(sorted, sorted_C);
  EXPECT_EQ(C, sorted_C);
  Field Y(F.patch_count(), 3), sorted_Y(F.patch_count(), 3);
  transport.multiply_left(C, Y);
  transport.multiply_left_sorted(C, sorted_Y);
  EXPECT_EQ(Field(Y(order, Eigen::all)), sorted_Y);
}

TEST(SparseV, TakesHalfTheBytesOfFullV) {
  const FormFactors F = factors_of("cube", 864);
  const auto bytes = [&](const char* spec) {
    for (const auto& [part, size] : cpu_operators().make(spec, F)->bytes().parts)
      if (part == "V" || part == "offsets") return size;
    return std::size_t{0};
  };
  EXPECT_EQ(bytes("2msc:k=54"), std::size_t{54 * 896 * 4});
  EXPECT_EQ(bytes("sparse-v:k=54"), std::size_t{55 * 8});
}

TEST(SparseV, DirectlyFromTheMeshesIsNearTheSums) {
  const FormFactors F = factors_of("clutter", 400);
  const Field sums = materialized(*cpu_operators().make("sparse-v:k=100", F));
  FormFactors mesh_alone;
  mesh_alone.mesh = F.mesh;
  const OperatorRegistry registry = cpu_operators();
  EXPECT_TRUE(registry.needs_form_factors("sparse-v:k=100"));
  ASSERT_FALSE(registry.needs_form_factors("sparse-v:k=100,factors=direct"));
  const Field direct = materialized(*registry.make("sparse-v:k=100,factors=direct", mesh_alone));
  EXPECT_LE((direct - sums).norm(), 0.05 * sums.norm());
  EXPECT_THROW(registry.make("sparse-v:k=100", mesh_alone), UsageError);
  EXPECT_THROW(registry.make("sparse-v:k=5,factors=direct", mesh_alone), UsageError);
  EXPECT_THROW(registry.make("sparse-v:k=100,factors=direct",
                             form_factors_of(exact_rooms::sphere_cavity(200, 1, 0.5))),
               UsageError);
}

TEST(TwoMesh, GroupsElementsWhereThereIsNoCoarseMesh) {
  const FormFactors many_faces = factors_of("sphere-cavity", 288);
  const auto transport = cpu_operators().make("2msc:k=40", many_faces);
  EXPECT_NE(transport->remark().find("40 compact sets"), std::string::npos) << transport->remark();
  EXPECT_TRUE(cpu_operators().make("2msc:k=40", factors_of("cube", 384))->remark().empty());
}

}  // namespace
}  // namespace radiosity

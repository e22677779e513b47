#include "operators/two_mesh_operator.hpp"

#include "form_factors/patch_sums.hpp"
#include "foundation/error.hpp"
#include "operators/direct_two_mesh.hpp"
#include "operators/low_rank_operator.hpp"
#include "operators/sparse_v_operator.hpp"
#include "operators/two_sided_operator.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <utility>

namespace radiosity {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// V of Equation 6, n x k in the order of the mesh.
MatrixXd full_right_factor(const FormFactors& form_factors, const ElementPartition& partition) {
  MatrixXd V = MatrixXd::Zero(partition.elements(), partition.patches());
  for (Index e = 0; e < V.rows(); ++e)
    V(e, partition.patch_of_element()[static_cast<std::size_t>(e)]) =
        partition.equal_areas() ? 1 : form_factors.mesh->area[e];
  return V;
}

/// K W = A^{1/2} F_ep A_p^{-1/2}.
MatrixXd kernel_on_patches(const FormFactors& form_factors, const ElementPartition& partition) {
  return form_factors.mesh->area.cwiseSqrt().asDiagonal() *
         patch_sums(form_factors, partition.patch_of_element(), partition.patches()) *
         partition.patch_area().cwiseSqrt().cwiseInverse().asDiagonal();
}

template <typename Scalar>
std::unique_ptr<LinearOperator> make_one_sided(const FormFactors& form_factors, const ChosenPartition& chosen,
                                               std::string spec) {
  return std::make_unique<LowRankOperator<Scalar>>(
      form_factors, two_mesh_left_factor(form_factors, chosen.partition),
      full_right_factor(form_factors, chosen.partition), std::move(spec), chosen.remark);
}

template <typename Scalar>
std::unique_ptr<LinearOperator> make_two_sided(const FormFactors& form_factors, const ChosenPartition& chosen,
                                               std::string spec) {
  return std::make_unique<TwoSidedOperator<Scalar>>(form_factors, chosen.partition.orthonormal_indicators(),
                                                    kernel_on_patches(form_factors, chosen.partition),
                                                    std::move(spec), chosen.remark);
}

template <typename Scalar>
std::unique_ptr<LinearOperator> make_sparse_v(const FormFactors& form_factors, const ChosenPartition& chosen,
                                              std::string spec) {
  Segments V = chosen.partition.right_factor();
  MatrixXd U = two_mesh_left_factor(form_factors, chosen.partition);
  if (!V.order().empty()) U = MatrixXd(U(V.order(), Eigen::all));
  return std::make_unique<SparseVOperator<Scalar>>(form_factors, std::move(V), FactorMatrix<Scalar>(U),
                                                   std::move(spec), chosen.remark);
}

/// U without F, from the mesh of `form_factors`.
std::unique_ptr<LinearOperator> make_direct_sparse_v(Spec& spec, const FormFactors& form_factors,
                                                     const PartitionChoice& choice,
                                                     const std::string& storage,
                                                     const std::string& described) {
  ElementFactorOptions options;
  options.tolerance = spec.number("tolerance", options.tolerance, 1e-9, 1);
  options.seed =
      static_cast<std::uint64_t>(spec.integer("seed", 1, 0, std::numeric_limits<std::int64_t>::max()));
  spec.finish();
  if (storage != "f32") fail<UsageError>("'{}': factors=direct keeps U as f32 only", spec.text());
  if (!form_factors.mesh->scene)
    fail<UsageError>("'{}': factors=direct needs the scene, of which nothing is known here", spec.text());
  SilentMonitor monitor;
  return make_direct_two_mesh(
             form_factors.mesh, choice, options,
             fmt::format("{},tolerance={},seed={}", described, options.tolerance, options.seed), monitor)
      .transport;
}

}  // namespace

MatrixXd two_mesh_left_factor(const FormFactors& form_factors, const ElementPartition& partition) {
  return patch_sums(form_factors, partition.patch_of_element(), partition.patches()) *
         partition.divisors().cwiseInverse().asDiagonal();
}

std::unique_ptr<LinearOperator> make_two_mesh_operator(Spec& spec, const FormFactors& form_factors) {
  const PartitionChoice choice = PartitionChoice::take(spec);
  const std::string sides = spec.choice("sides", "one", {"one", "two"});
  const std::string storage = spec.choice("storage", "f32", {"f32", "f64"});
  spec.finish();
  if (sides == "two" && !form_factors.symmetric())
    fail<UsageError>(
        "sides=two needs a symmetric kernel, which form factors by '{}' do not have: use sides=one",
        form_factors.quality.method);
  const ChosenPartition chosen = choose_partition(form_factors, choice);
  const std::string described =
      fmt::format("2msc:k={},{},sides={},storage={}", choice.patches, choice.text, sides, storage);
  if (sides == "two")
    return storage == "f64" ? make_two_sided<double>(form_factors, chosen, described)
                            : make_two_sided<float>(form_factors, chosen, described);
  return storage == "f64" ? make_one_sided<double>(form_factors, chosen, described)
                          : make_one_sided<float>(form_factors, chosen, described);
}

std::unique_ptr<LinearOperator> make_sparse_v_operator(Spec& spec, const FormFactors& form_factors) {
  const PartitionChoice choice = PartitionChoice::take(spec);
  const std::string storage = spec.choice("storage", "f32", {"f32", "f64"});
  const std::string factors = spec.choice("factors", "sums", {"sums", "direct"});
  const std::string described =
      fmt::format("sparse-v:k={},{},storage={},factors={}", choice.patches, choice.text, storage, factors);
  if (factors == "direct") return make_direct_sparse_v(spec, form_factors, choice, storage, described);
  spec.finish();
  const ChosenPartition chosen = choose_partition(form_factors, choice);
  return storage == "f64" ? make_sparse_v<double>(form_factors, chosen, described)
                          : make_sparse_v<float>(form_factors, chosen, described);
}

}  // namespace radiosity

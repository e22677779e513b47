#include "operators/qr_operator.hpp"

#include "factorizations/leading_columns.hpp"
#include "operators/element_partition.hpp"
#include "operators/low_rank_choice.hpp"
#include "operators/two_mesh_operator.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <limits>

namespace radiosity {

namespace {

/// From the columns of F summed over the patches of a coarse mesh: the U of 2MSC.
std::unique_ptr<LinearOperator> make_from_two_meshes(const LowRankChoice& choice, Spec& spec,
                                                     const FormFactors& form_factors) {
  const PartitionChoice meshes = PartitionChoice::take(spec);
  spec.finish();
  choice.require_kernel(form_factors);
  const ChosenPartition chosen = choose_partition(form_factors, meshes);
  Eigen::MatrixXd basis = two_mesh_left_factor(form_factors, chosen.partition);
  if (choice.in_area_norm()) basis = form_factors.mesh->area.cwiseSqrt().asDiagonal() * basis;
  const LowRankPair pair = project_on_columns(form_factor_products(form_factors, choice.norm), basis);
  LowRankChoice made = choice;
  made.rank = chosen.partition.patches();
  return make_low_rank_operator(made, form_factors, pair,
                                fmt::format("qr:{},columns=2msc,{}", choice.text(), meshes.text));
}

}  // namespace

std::unique_ptr<LinearOperator> make_qr_operator(Spec& spec, const FormFactors& form_factors) {
  const LowRankChoice choice = LowRankChoice::take(spec);
  const std::string columns = spec.choice("columns", "2msc", {"2msc", "pivoted"});
  if (columns == "2msc") return make_from_two_meshes(choice, spec, form_factors);
  const std::int64_t seed = spec.integer("seed", 1, 0, std::numeric_limits<std::int64_t>::max());
  spec.finish();
  choice.require_kernel(form_factors);
  const MatrixProducts products = form_factor_products(form_factors, choice.norm);
  const Eigen::MatrixXd basis =
      columns_of(products, leading_columns(products, choice.rank, static_cast<std::uint64_t>(seed)));
  return make_low_rank_operator(choice, form_factors, project_on_columns(products, basis),
                                fmt::format("qr:{},columns={},seed={}", choice.text(), columns, seed));
}

}  // namespace radiosity

#include "operators/low_rank_choice.hpp"

#include "foundation/error.hpp"
#include "operators/low_rank_operator.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace radiosity {

LowRankChoice LowRankChoice::take(Spec& spec) {
  LowRankChoice choice;
  choice.rank = spec.integer("k", choice.rank, 1, 1 << 20);
  if (spec.choice("norm", "plain", {"plain", "area"}) == "area") choice.norm = FactorizationNorm::area;
  choice.storage = spec.choice("storage", "f32", {"f32", "f64"});
  return choice;
}

Eigen::VectorXd LowRankChoice::root_weight(const PatchMesh& mesh) const {
  if (in_area_norm()) return mesh.area.cwiseSqrt();
  return Eigen::VectorXd::Ones(mesh.patch_count());
}

std::string LowRankChoice::text() const {
  return fmt::format("k={},norm={},storage={}", rank, in_area_norm() ? "area" : "plain", storage);
}

void LowRankChoice::require_kernel(const FormFactors& form_factors) const {
  if (in_area_norm() && !form_factors.symmetric())
    fail<UsageError>(
        "norm=area needs a symmetric kernel, which form factors by '{}' do not have: use norm=plain",
        form_factors.quality.method);
}

std::unique_ptr<LinearOperator> make_low_rank_operator(const LowRankChoice& choice,
                                                       const FormFactors& form_factors, LowRankPair pair,
                                                       std::string spec) {
  if (choice.in_area_norm()) {
    const Eigen::VectorXd root = form_factors.mesh->area.cwiseSqrt();
    pair.U = root.cwiseInverse().asDiagonal() * pair.U;
    pair.V = root.asDiagonal() * pair.V;
  }
  const Index asked = std::min(choice.rank, form_factors.patch_count());
  std::string remark;
  if (pair.U.cols() < asked)
    remark = fmt::format("{} of {} columns: the others depend on them to rounding", pair.U.cols(), asked);
  return make_stored_as<LowRankOperator>(choice.storage, form_factors, pair.U, pair.V, std::move(spec),
                                         std::move(remark));
}

}  // namespace radiosity

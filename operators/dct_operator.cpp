#include "operators/dct_operator.hpp"

#include "factorizations/cosines.hpp"
#include "operators/low_rank_choice.hpp"
#include "operators/patch_planes.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <utility>

namespace radiosity {
std::unique_ptr<LinearOperator> make_dct_operator(Spec& spec, const FormFactors& form_factors) {
  const LowRankChoice choice = LowRankChoice::take(spec);
  const std::int64_t seed = spec.integer("seed", 1, 0, std::numeric_limits<std::int64_t>::max());
  spec.finish();
  choice.require_kernel(form_factors);
  const PatchMesh& mesh = *form_factors.mesh;
  LowRankPair pair = project_on_functions(form_factor_products(form_factors, choice.norm),
                                          cosines(patch_planes(mesh), choice.root_weight(mesh)), choice.rank,
                                          static_cast<std::uint64_t>(seed));
  return make_low_rank_operator(choice, form_factors, std::move(pair),
                                fmt::format("dct:{},seed={}", choice.text(), seed));
}

}  // namespace radiosity

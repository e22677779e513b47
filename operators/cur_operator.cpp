#include "operators/cur_operator.hpp"

#include "factorizations/cur.hpp"
#include "operators/low_rank_choice.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <limits>

namespace radiosity {

std::unique_ptr<LinearOperator> make_cur_operator(Spec& spec, const FormFactors& form_factors) {
  const LowRankChoice choice = LowRankChoice::take(spec);
  const std::string core = spec.choice("core", "projection", {"projection", "interpolation"});
  const std::int64_t seed = spec.integer("seed", 1, 0, std::numeric_limits<std::int64_t>::max());
  spec.finish();
  choice.require_kernel(form_factors);
  const CurOptions options = {.rank = choice.rank,
                              .core = core == "projection" ? CurCore::projection : CurCore::interpolation,
                              .seed = static_cast<std::uint64_t>(seed)};
  CurDecomposition cur = cur_decomposition(form_factor_products(form_factors, choice.norm), options);
  return make_low_rank_operator(choice, form_factors, std::move(cur.factors),
                                fmt::format("cur:{},core={},seed={}", choice.text(), core, seed));
}

}  // namespace radiosity

#include "operators/qr_operator.hpp"

#include "factorizations/leading_columns.hpp"
#include "operators/low_rank_choice.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <limits>

namespace radiosity {

std::unique_ptr<LinearOperator> make_qr_operator(Spec& spec, const FormFactors& form_factors) {
  const LowRankChoice choice = LowRankChoice::take(spec);
  const std::string columns = spec.choice("columns", "pivoted", {"pivoted"});
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

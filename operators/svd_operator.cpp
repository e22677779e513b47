#include "operators/svd_operator.hpp"

#include "factorizations/lanczos_svd.hpp"
#include "factorizations/lapack.hpp"
#include "factorizations/randomized_svd.hpp"
#include "foundation/memory.hpp"
#include "operators/low_rank_choice.hpp"
#include "operators/low_rank_operator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace radiosity {
namespace {

using Eigen::MatrixXd;

LowRankPair scaled_left(const SingularValues& svd, Index rank) {
  return {svd.U.leftCols(rank) * svd.values.head(rank).asDiagonal(), svd.V.leftCols(rank)};
}

/// By Lanczos nothing is known for certain of the pairs that are left out: no certificate.
std::unique_ptr<LinearOperator> make_lanczos_operator(const LowRankChoice& choice,
                                                      const FormFactors& form_factors,
                                                      const std::string& described) {
  const MatrixProducts products = form_factor_products(form_factors, choice.norm);
  if (choice.in_area_norm()) {
    const SymmetricEigenpairs pairs = lanczos_eigenpairs(products, {.rank = choice.rank});
    return make_stored_as<LowRankKernelOperator>(choice.storage, form_factors, pairs.vectors, pairs.values,
                                                 std::optional<double>(), described);
  }
  const SingularValues svd = lanczos_svd(products, {.rank = choice.rank});
  return make_low_rank_operator(choice, form_factors, scaled_left(svd, svd.values.size()), described);
}

}  // namespace

std::unique_ptr<LinearOperator> make_svd_operator(Spec& spec, const FormFactors& form_factors) {
  const LowRankChoice choice = LowRankChoice::take(spec);
  const std::string method = spec.choice("method", "dense", {"dense", "lanczos"});
  spec.finish();
  choice.require_kernel(form_factors);
  const std::string described = fmt::format("svd:{},method={}", choice.text(), method);
  if (method == "lanczos") return make_lanczos_operator(choice, form_factors, described);
  const auto n = static_cast<double>(form_factors.patch_count());
  // The matrix, its vectors (of the kernel the same on both sides), and what LAPACK works in.
  const double matrices = choice.in_area_norm() ? 3 : 5;
  require_available_memory(fmt::format("{} of {} patches", described, form_factors.patch_count()),
                           matrices * sizeof(double) * n * n, "take rsvd or method=lanczos");
  if (choice.in_area_norm()) {
    const SymmetricEigenpairs all = symmetric_eigenpairs(materialize(*form_factors.kernel));
    const SymmetricEigenpairs more = largest_in_magnitude(all, choice.rank + 1);
    const SymmetricEigenpairs kept = largest_in_magnitude(more, choice.rank);
    const bool left_out = more.values.size() > kept.values.size();
    return make_stored_as<LowRankKernelOperator>(
        choice.storage, form_factors, kept.vectors, kept.values,
        std::optional<double>(left_out ? std::fabs(more.values.tail(1)[0]) : 0), described);
  }
  const SingularValues svd = singular_value_decomposition(form_factors.matrix());
  const Index rank = std::min(choice.rank, svd.values.size());
  return make_low_rank_operator(choice, form_factors, scaled_left(svd, rank), described);
}

std::unique_ptr<LinearOperator> make_rsvd_operator(Spec& spec, const FormFactors& form_factors) {
  const LowRankChoice choice = LowRankChoice::take(spec);
  RandomizedSvdOptions options;
  options.rank = choice.rank;
  options.power_steps = static_cast<int>(spec.integer("power", options.power_steps, 0, 100));
  options.oversampling = spec.integer("oversampling", options.oversampling, 0, 1 << 20);
  options.seed =
      static_cast<std::uint64_t>(spec.integer("seed", 1, 0, std::numeric_limits<std::int64_t>::max()));
  spec.finish();
  choice.require_kernel(form_factors);
  const std::string described = fmt::format("rsvd:{},power={},oversampling={},seed={}", choice.text(),
                                            options.power_steps, options.oversampling, options.seed);
  const MatrixProducts products = form_factor_products(form_factors, choice.norm);
  const SingularValues svd = randomized_svd(products, options);
  if (!choice.in_area_norm())
    return make_low_rank_operator(choice, form_factors, scaled_left(svd, svd.values.size()), described);
  // The range of the sketch is spanned by U; Rayleigh and Ritz give eigenpairs in it.
  const MatrixXd projected = svd.U.transpose() * products.apply(svd.U);
  const SymmetricEigenpairs pairs = symmetric_eigenpairs(0.5 * (projected + projected.transpose()));
  return make_stored_as<LowRankKernelOperator>(choice.storage, form_factors, MatrixXd(svd.U * pairs.vectors),
                                               pairs.values, std::optional<double>(), described);
}

}  // namespace radiosity

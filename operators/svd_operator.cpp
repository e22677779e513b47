#include "operators/svd_operator.hpp"

#include "factorizations/lapack.hpp"
#include "factorizations/randomized_svd.hpp"
#include "foundation/error.hpp"
#include "operators/low_rank_operator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace radiosity {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct SvdChoice {
  Index rank = 64;
  bool area_norm = false;
  std::string storage;
  std::string text;  ///< the keys

  static SvdChoice take(Spec& spec) {
    SvdChoice choice;
    choice.rank = spec.integer("k", choice.rank, 1, 1 << 20);
    choice.area_norm = spec.text("norm", "plain") == "area";
    choice.storage = spec.choice("storage", "f32", {"f32", "f64"});
    choice.text = fmt::format("k={},norm={},storage={}", choice.rank, choice.area_norm ? "area" : "plain",
                              choice.storage);
    return choice;
  }
};

void require_area_norm(const FormFactors& form_factors, const SvdChoice& choice) {
  if (choice.area_norm && !form_factors.symmetric())
    fail<UsageError>(
        "norm=area needs a symmetric kernel, which form factors by '{}' do not have: use norm=plain",
        form_factors.quality.method);
}

/// Eigenpairs of largest magnitude, and the magnitude of the first that is left out.
struct Truncated {
  MatrixXd Q;
  VectorXd values;
  double left_out = 0;
};

Truncated truncate(const SymmetricEigenpairs& pairs, Index rank) {
  std::vector<Index> order(static_cast<std::size_t>(pairs.values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return std::fabs(pairs.values[a]) > std::fabs(pairs.values[b]); });
  const auto kept = std::min(order.size(), static_cast<std::size_t>(rank));
  Truncated result;
  if (kept < order.size()) result.left_out = std::fabs(pairs.values[order[kept]]);
  order.resize(kept);
  result.Q = pairs.vectors(Eigen::all, order);
  result.values = pairs.values(order);
  return result;
}

template <template <typename> class Operator, typename... Arguments>
std::unique_ptr<LinearOperator> make_low_rank(const std::string& storage, Arguments&&... arguments) {
  if (storage == "f64") return std::make_unique<Operator<double>>(std::forward<Arguments>(arguments)...);
  return std::make_unique<Operator<float>>(std::forward<Arguments>(arguments)...);
}

/// Products with F or, in the area norm, with K.
MatrixProducts products_of(const FormFactors& form_factors, bool area_norm) {
  const Index n = form_factors.patch_count();
  const VectorXd root = form_factors.mesh->area.cwiseSqrt();
  const auto through = [](const auto& multiply_with) {
    return [multiply_with](const MatrixXd& X) {
      MatrixXd Y(X.rows(), X.cols());
      multiply_with(X, Y);
      return Y;
    };
  };
  if (!form_factors.symmetric()) {
    const auto matrix = form_factors.unsymmetric;
    return {n, n, through([matrix](const MatrixXd& X, MatrixXd& Y) { multiply(*matrix, X, Y); }),
            through([matrix](const MatrixXd& X, MatrixXd& Y) { multiply_transposed(*matrix, X, Y); })};
  }
  const auto kernel = form_factors.kernel;
  if (area_norm) {
    const auto symmetric = through([kernel](const MatrixXd& X, MatrixXd& Y) { multiply(*kernel, X, Y); });
    return {n, n, symmetric, symmetric};
  }
  // F = A^{-1/2} K A^{1/2}.
  return {n, n, through([kernel, root](const MatrixXd& X, MatrixXd& Y) {
            multiply(*kernel, root.asDiagonal() * X, Y);
            Y = root.cwiseInverse().asDiagonal() * Y;
          }),
          through([kernel, root](const MatrixXd& X, MatrixXd& Y) {
            multiply(*kernel, root.cwiseInverse().asDiagonal() * X, Y);
            Y = root.asDiagonal() * Y;
          })};
}

}  // namespace

std::unique_ptr<LinearOperator> make_svd_operator(Spec& spec, const FormFactors& form_factors) {
  const SvdChoice choice = SvdChoice::take(spec);
  spec.finish();
  require_area_norm(form_factors, choice);
  const std::string described = "svd:" + choice.text;
  if (choice.area_norm) {
    const Truncated kept = truncate(symmetric_eigenpairs(materialize(*form_factors.kernel)), choice.rank);
    return make_low_rank<LowRankKernelOperator>(choice.storage, form_factors, kept.Q, kept.values,
                                                std::optional<double>(kept.left_out), described);
  }
  const SingularValues svd = singular_value_decomposition(form_factors.matrix());
  const Index rank = std::min(choice.rank, svd.values.size());
  return make_low_rank<LowRankOperator>(choice.storage, form_factors,
                                        MatrixXd(svd.U.leftCols(rank) * svd.values.head(rank).asDiagonal()),
                                        MatrixXd(svd.V.leftCols(rank)), described);
}

std::unique_ptr<LinearOperator> make_rsvd_operator(Spec& spec, const FormFactors& form_factors) {
  const SvdChoice choice = SvdChoice::take(spec);
  RandomizedSvdOptions options;
  options.rank = choice.rank;
  options.power_steps = static_cast<int>(spec.integer("power", options.power_steps, 0, 100));
  options.oversampling = spec.integer("oversampling", options.oversampling, 0, 1 << 20);
  options.seed =
      static_cast<std::uint64_t>(spec.integer("seed", 1, 0, std::numeric_limits<std::int64_t>::max()));
  spec.finish();
  require_area_norm(form_factors, choice);
  const std::string described = fmt::format("rsvd:{},power={},oversampling={},seed={}", choice.text,
                                            options.power_steps, options.oversampling, options.seed);
  const MatrixProducts products = products_of(form_factors, choice.area_norm);
  const SingularValues svd = randomized_svd(products, options);
  if (!choice.area_norm)
    return make_low_rank<LowRankOperator>(choice.storage, form_factors,
                                          MatrixXd(svd.U * svd.values.asDiagonal()), svd.V, described);
  // The range of the sketch is spanned by U; Rayleigh and Ritz give eigenpairs in it.
  const MatrixXd projected = svd.U.transpose() * products.apply(svd.U);
  const SymmetricEigenpairs pairs = symmetric_eigenpairs(0.5 * (projected + projected.transpose()));
  return make_low_rank<LowRankKernelOperator>(choice.storage, form_factors, MatrixXd(svd.U * pairs.vectors),
                                              pairs.values, std::optional<double>(), described);
}

}  // namespace radiosity

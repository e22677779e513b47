#include "experiments/low_rank_radiosity/dense_solutions.hpp"

#include "experiments/low_rank_radiosity/cube_meshes.hpp"
#include "experiments/low_rank_radiosity/error_study_measures.hpp"
#include "experiments/low_rank_radiosity/precomputed_woodbury.hpp"
#include "experiments/reference_solution.hpp"
#include "foundation/error.hpp"
#include "kernels/segment_sums.hpp"

#include <memory>
#include <utility>

namespace radiosity {
namespace {

/// B = E - Y (V' E) for fields in the order of the mesh.
Field precomputed_answer(const Segments& V, const TallMatrix<float>& Y, const Field& E) {
  const bool sorted = V.order().empty();
  const Field sorted_emission = sorted ? E : Field(E(V.order(), Eigen::all));
  Field X(Y.columns(), E.cols());
  Field sorted_answer(E.rows(), E.cols());
  segment_sums(V, sorted_emission, X, RowOrder::sorted);
  subtract_product(Y, X, sorted_emission, sorted_answer);
  if (sorted) return sorted_answer;
  Field B(E.rows(), E.cols());
  B(V.order(), Eigen::all) = sorted_answer;
  return B;
}

}  // namespace

std::optional<DenseErrors> DenseSolutions::compare(const Segments& V, const TallMatrix<float>& Y,
                                                   Monitor& monitor) {
  if (static_cast<double>(Y.rows()) > options_.largest_dense_error) return std::nullopt;
  const Solution& dense = solution(Y.rows(), monitor);
  const Field B = precomputed_answer(V, Y, dense.E);
  return DenseErrors{mean_of(relative_errors(dense.mesh, B, dense.B)),
                     mean_of(relative_errors(dense.mesh, Field(B - dense.E), Field(dense.B - dense.E))),
                     ((B - dense.B).array().abs() / dense.B.array()).maxCoeff()};
}

const DenseSolutions::Solution& DenseSolutions::solution(Index n, Monitor& monitor) {
  const auto known = solutions_.find(n);
  if (known != solutions_.end()) return known->second;
  const FormFactors form_factors =
      compute_form_factors(std::make_shared<const PatchMesh>(cube_mesh(n)), {.seed = options_.seed}, monitor);
  Field E = draw_lights(*form_factors.mesh, options_.lights, options_.seed, monitor).emission;
  std::optional<Field> B = reference_solution(form_factors, E);
  if (!B) fail("the dense solution of the cube of {} patches was not found", n);
  return solutions_.emplace(n, Solution{*form_factors.mesh, std::move(E), std::move(*B)}).first->second;
}

}  // namespace radiosity

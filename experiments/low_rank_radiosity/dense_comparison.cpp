#include "experiments/low_rank_radiosity/dense_comparison.hpp"

#include "experiments/low_rank_radiosity/cube_meshes.hpp"
#include "experiments/low_rank_radiosity/precomputed_woodbury.hpp"
#include "experiments/reference_solution.hpp"
#include "foundation/error.hpp"
#include "kernels/segment_sums.hpp"
#include "operators/direct_two_mesh.hpp"
#include "operators/two_mesh_operator.hpp"
#include "scene/coarse_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

namespace radiosity {
namespace {

FormFactors assembled_cube(Index patches, std::uint64_t seed, Monitor& monitor) {
  return compute_form_factors(std::make_shared<const PatchMesh>(cube_mesh(patches)), {.seed = seed}, monitor);
}

/// Largest |B - B_dense| / B_dense for B = E - Y (V' E).
double largest_difference(const Segments& V, const TallMatrix<float>& Y, const Field& E, const Field& dense) {
  Field X(Y.columns(), E.cols());
  Field B(E.rows(), E.cols());
  segment_sums(V, E, X);
  subtract_product(Y, X, E, B);
  return ((B - dense).array().abs() / dense.array()).maxCoeff();
}

/// As many patches as elements, each its own.
CoarseMesh elements_as_patches(const PatchMesh& elements) {
  return assign_elements(elements, elements, Assignment::inclusion);
}

}  // namespace

std::vector<DenseComparison> compare_with_dense(const LowRankTablesOptions& options,
                                                const OperatorRegistry& operators,
                                                const SolverRegistry& solvers, Monitor& monitor) {
  std::vector<DenseComparison> errors;
  std::set<Index> compared;
  for (const LowRankSize& size : options.sizes) {
    errors.push_back({size, {}, {}});
    if (static_cast<double>(size.rows) <= options.largest_dense_error) compared.insert(size.rows);
  }
  for (const Index n : compared) {
    ComparisonOptions comparison;
    comparison.solver = "woodbury";
    comparison.lights = options.lights;
    comparison.seed = options.seed;
    comparison.machine = Machine{};
    comparison.largest_measured = 0;
    std::vector<DenseComparison*> results;
    for (DenseComparison& error : errors) {
      if (error.size.rows != n) continue;
      results.push_back(&error);
      comparison.operators.push_back(fmt::format("sparse-v:k={},mesh=uniform", error.size.rank));
    }
    const Comparison compared_with =
        compare(assembled_cube(n, options.seed, monitor), operators, solvers, comparison, monitor);
    for (std::size_t i = 0; i < results.size(); ++i) {
      results[i]->radiosity_mean = compared_with.results[i].errors.radiosity_mean;
      results[i]->indirect_mean = compared_with.results[i].errors.indirect_mean;
    }
  }
  return errors;
}

DenseEquality measure_equality(const LowRankTablesOptions& options, Monitor& monitor) {
  const Index n = options.equal_size.rows;
  const FormFactors form_factors = assembled_cube(n, options.seed, monitor);
  const PatchMesh& mesh = *form_factors.mesh;
  const Field E = draw_lights(mesh, options.lights, options.seed, monitor).emission;
  const std::optional<Field> dense = reference_solution(form_factors, E);
  if (!dense) fail("the dense solution of the cube of {} patches was not found", n);

  const CoarseMesh coarse = elements_as_patches(mesh);
  const ElementPartition partition(coarse.patch_of_element, mesh.area);
  const Segments V = partition.right_factor();
  const Eigen::VectorXd reflectance = mesh.reflectance.col(0);
  DenseEquality equality{n, 0, 0};
  equality.same_factors = largest_difference(
      V,
      precompute_woodbury(V, TallMatrix<float>(two_mesh_left_factor(form_factors, partition)), reflectance,
                          monitor),
      E, *dense);
  DirectTwoMeshFactors direct =
      compute_two_mesh_factors(mesh, coarse, {.tolerance = options.tolerance, .seed = options.seed}, monitor);
  equality.direct_factors = largest_difference(
      direct.V, precompute_woodbury(direct.V, std::move(direct.U), reflectance, monitor), E, *dense);
  return equality;
}

}  // namespace radiosity

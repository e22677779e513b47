// %% [markdown]
// # From spectrum to Woodbury
//
// Document 004 replaces the transport operator by a product of two thin matrices and solves it directly. This
// notebook asks whether that is allowed. The spectrum of F says no: a shelf of singular values stays however
// fine the mesh is. The solution says yes: what stands on the shelf hardly matters to it. Then two meshes,
// sums instead of a matrix V, and Woodbury's formula give the light of a room in two products, also when its
// walls are painted.
//
// The cells below are also a program: `notebook_03_from_spectrum_to_woodbury FOLDER` writes its plots into
// FOLDER, prints what it finds, and fails if one of the facts that it states is wrong.

// %%
#include "experiments/lights.hpp"
#include "experiments/low_rank_radiosity/adjacent_patches.hpp"
#include "experiments/low_rank_radiosity/patch_drawing.hpp"
#include "experiments/reference_solution.hpp"
#include "experiments/svg_plot.hpp"
#include "factorizations/lapack.hpp"
#include "form_factors/form_factors.hpp"
#include "kernels/segment_sums.hpp"
#include "operators/element_partition.hpp"
#include "operators/kernel_operator.hpp"
#include "operators/operator_registry.hpp"
#include "operators/two_mesh_operator.hpp"
#include "scene/built_in.hpp"
#include "scene/patch_mesh.hpp"
#include "solvers/solver_registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

using namespace radiosity;

bool all_facts_hold = true;

PlotPoint point(double x, double y) {
  return {x, std::max(y, 1e-16), 0, ""};
}

void state(const std::string& fact, bool holds) {
  fmt::print("{}: {}\n", holds ? "true " : "FALSE", fact);
  all_facts_hold = all_facts_hold && holds;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value / static_cast<double>(values.size());
  return sum;
}

// %% tags=["program"]
int main(int argc, char** argv) try {
  const std::filesystem::path folder = argc > 1 ? argv[1] : ".";

  // %% tags=["notebook"]
  // const std::filesystem::path folder = ".";

  // %% [markdown]
  // ## The matrix and its spectrum
  //
  // The inside of a unit cube, each face in 10 x 10 squares: n = 600. The best approximation of F of rank k
  // leaves out all singular values but the k largest (Eckart and Young); if they fall quickly, F is nearly of
  // low rank.

  // %%
  std::filesystem::create_directories(folder);
  const auto mesh = std::make_shared<const PatchMesh>(make_patches(built_in_scene("cube"), {.patches = 600}));
  SilentMonitor monitor;
  const FormFactors form_factors = compute_form_factors(mesh, {}, monitor);
  const Index n = form_factors.patch_count();
  const Eigen::MatrixXd F = form_factors.matrix();
  const Eigen::VectorXd sigma = singular_value_decomposition(F).values;
  state(fmt::format("there are {} patches, and the largest singular value is {:.6f}", n, sigma[0]),
        n == 600 && std::abs(sigma[0] - 1) <= 1e-6);

  // %% [markdown]
  // ## The shelf
  //
  // They do not: hundreds are about as large as each other. Two patches that meet at an edge of the cube see
  // F = 0.2 of each other whatever their size, and almost nobody else sees them so well. Such a pair is a
  // block [0 f; f 0] with the singular values f and f. There are 12 edges of 10 pairs each: 240 singular
  // values that no finer mesh takes away (it has more pairs, with the same f). Without these pairs
  // the shelf is gone.

  // %%
  const auto pairs = adjacent_patches(*mesh);
  Eigen::MatrixXd without_edges = F;
  double least = 1, largest = 0;
  for (const auto& [i, j] : pairs) {
    without_edges(i, j) = without_edges(j, i) = 0;
    least = std::min(least, F(i, j));
    largest = std::max(largest, F(i, j));
  }
  const Eigen::VectorXd sigma_without_edges = singular_value_decomposition(without_edges).values;
  const Index shelf = (sigma.array() > 0.1).count();
  const Index shelf_without_edges = (sigma_without_edges.array() > 0.1).count();
  state(fmt::format("{} pairs meet at an edge, with F from {:.4f} to {:.4f}", pairs.size(), least, largest),
        pairs.size() == 12 * 10 && least > 0.19 && largest < 0.21);
  state(
      fmt::format("{} singular values are above 0.1, and {} without those pairs", shelf, shelf_without_edges),
      shelf >= 200 && shelf_without_edges <= 60);

  const auto series_of = [](const std::string& name, const Eigen::VectorXd& values) {
    PlotSeries series{.name = name, .points = {}, .markers = false};
    for (Index k = 0; k < values.size(); ++k)
      series.points.push_back(point(static_cast<double>(k + 1), values[k]));
    return series;
  };
  Plot spectrum_plot;
  spectrum_plot.title = "Singular values of F, cube, n = 600";
  spectrum_plot.panels.push_back(
      {.title = "",
       .x = {.label = "number"},
       .y = {.label = "singular value", .scale = Scale::logarithmic, .low = 1e-6},
       .series = {series_of("F", sigma), series_of("without pairs at edges", sigma_without_edges)}});
  write_svg(folder / "singular_values.svg", spectrum_plot);

  // %% [markdown]
  // ## The operator is not of low rank, the solution is
  //
  // With the best approximation of each rank: how far T is off, and how far the radiosity B that it gives,
  // for discs of light somewhere on the walls. What stands on the shelf moves light from a patch to its
  // neighbour round the corner and back, in patterns that alternate from patch to patch; light that arrives
  // from afar has hardly any of these.

  // %%
  const LightSet lights = draw_lights(*mesh, {.area = 12}, 1, monitor);
  const auto exact = reference_solution(form_factors, lights.emission);
  state("the dense operator has a solution", exact.has_value());
  const Field& B = *exact;

  PlotSeries error_in_T{.name = "error in T", .points = {}};
  PlotSeries error_in_B{.name = "error in B", .points = {}};
  double worst_ratio = 1e300;
  for (const Index k : {4, 8, 16, 32, 64, 128, 256}) {
    const auto best = cpu_operators().make(fmt::format("svd:k={},storage=f64", k), form_factors);
    const SolverProblem problem{*best, mesh->area.cwiseSqrt(), {.tolerance = 1e-10}};
    const Field answer = solve(*cpu_solvers().make("woodbury", problem), lights.emission);
    const double in_T = sigma.tail(n - k).norm() / sigma.norm();
    const double in_B = mean(relative_errors(*mesh, answer, B));
    fmt::print("       k = {:>3}: error in T {:.3f}, in B {:.4f}\n", k, in_T, in_B);
    error_in_T.points.push_back(point(static_cast<double>(k), in_T));
    error_in_B.points.push_back(point(static_cast<double>(k), in_B));
    worst_ratio = std::min(worst_ratio, in_T / in_B);
  }
  state(fmt::format("with k = 64 T is off by {:.2f} and B by {:.3f}", error_in_T.points[4].y,
                    error_in_B.points[4].y),
        error_in_T.points[4].y > 0.5 && error_in_B.points[4].y < 0.05);
  state(fmt::format("at every rank T is at least {:.1f} times as far off as B", worst_ratio),
        worst_ratio > 3);

  Plot error_plot;
  error_plot.title = "What rank k leaves out, cube, n = 600, reflectance 0.5";
  error_plot.panels.push_back({.title = "",
                               .x = {.label = "k", .scale = Scale::logarithmic},
                               .y = {.label = "relative error", .scale = Scale::logarithmic},
                               .series = {error_in_T, error_in_B}});
  write_svg(folder / "errors.svg", error_plot);

  // %% [markdown]
  // ## Two meshes
  //
  // An SVD needs all of F and n^3 work. Two meshes with spatial coherence need neither: n elements receive,
  // k patches send, and the elements of a patch are taken to be seen alike. Where scene views vary inside a
  // patch, it is cut. Here the corners and edges of the cube get the small patches.

  // %%
  const Index k = 96;
  const ElementPartition uniform =
      choose_partition(form_factors, {.patches = k, .adaptive = false, .text = ""}).partition;
  const ElementPartition adaptive =
      choose_partition(form_factors, {.patches = k, .adaptive = true, .text = ""}).partition;
  state(fmt::format("the uniform mesh has {} patches, the adaptive one {}", uniform.patches(),
                    adaptive.patches()),
        uniform.patches() == k && adaptive.patches() <= k);
  for (const bool cut_by_coherence : {false, true}) {
    const auto pair = make_coarse_mesh(*mesh, {.patches = k, .adaptive = cut_by_coherence, .text = ""});
    write_drawing(folder / (cut_by_coherence ? "adaptive_mesh.png" : "uniform_mesh.png"),
                  draw_patches(pair->patches, shaded_reflectance(pair->patches), {}, monitor));
  }

  // %% [markdown]
  // ## V is not a matrix
  //
  // V has a single 1 in each row, in the column of the element's patch. V'E adds up the elements of each
  // patch; sorted by patch, V is k + 1 offsets.

  // %%
  Eigen::MatrixXd V = Eigen::MatrixXd::Zero(n, k);
  for (Index e = 0; e < n; ++e) V(e, uniform.patch_of_element()[static_cast<std::size_t>(e)]) = 1;
  const Eigen::MatrixXd U = two_mesh_left_factor(form_factors, uniform);
  const Segments sums = uniform.right_factor();
  const Field& E = lights.emission;
  Field coefficients(k, E.cols());
  segment_sums(sums, E, coefficients);
  const double sum_error = (coefficients - V.transpose() * E).cwiseAbs().maxCoeff();
  state(fmt::format("sums over segments are V'E to {:.0e}", sum_error), sum_error <= 1e-12);
  state(fmt::format("V is {} offsets in place of {} numbers", sums.offsets().size(), V.size()),
        sums.offsets().size() == static_cast<std::size_t>(k + 1));

  // %% [markdown]
  // ## Woodbury's formula
  //
  // B = E + R U (I - V'R U)^-1 V'E. The only system has k unknowns: how much each patch sends in all.

  // %%
  const Eigen::VectorXd half = mesh->reflectance.col(0);
  const Eigen::MatrixXd RU = half.asDiagonal() * U;
  const LuFactors capacitance(Eigen::MatrixXd::Identity(k, k) - V.transpose() * RU);
  const Field by_hand = E + RU * capacitance.solve(coefficients);
  const double residual =
      (by_hand - E - half.asDiagonal() * (U * (V.transpose() * by_hand))).norm() / E.norm();
  state(fmt::format("it solves the approximate equation to {:.0e}", residual), residual <= 1e-13);

  const auto library =
      cpu_operators().make(fmt::format("sparse-v:k={},mesh=uniform,storage=f64", k), form_factors);
  const SolverProblem problem{*library, mesh->area.cwiseSqrt(), {.tolerance = 1e-10}};
  const Field by_library = solve(*cpu_solvers().make("woodbury", problem), E);
  const double disagreement = (by_library - by_hand).norm() / by_hand.norm();
  state(fmt::format("and is the library's solver: they agree to {:.0e}", disagreement),
        disagreement <= 1e-12);

  const double uniform_error = mean(relative_errors(*mesh, by_hand, B));
  state(fmt::format("from the dense solution it is {:.3f} away", uniform_error), uniform_error <= 0.06);

  // %% [markdown]
  // ## Painting the walls
  //
  // U and V know no reflectance. Another colour changes the k x k matrix and nothing else; the error stays
  // what it was. The library's operators in the area norm let the reflectance be set, and its solver notices.

  // %%
  Eigen::VectorXd painted = half;
  for (Index e = 0; e < n; ++e) painted[e] = std::abs(mesh->normal(1, e)) > 0.5 ? 0.2 : 0.8;
  FormFactors painted_room = form_factors;
  auto painted_mesh = std::make_shared<PatchMesh>(*mesh);
  painted_mesh->reflectance.col(0) = painted;
  painted_room.mesh = painted_mesh;
  const auto painted_B = reference_solution(painted_room, E);
  const double painted_change = mean(relative_errors(*mesh, B, *painted_B));
  const Eigen::MatrixXd painted_RU = painted.asDiagonal() * U;
  const LuFactors painted_capacitance(Eigen::MatrixXd::Identity(k, k) - V.transpose() * painted_RU);
  const Field repainted_by_hand = E + painted_RU * painted_capacitance.solve(coefficients);
  const double painted_error = mean(relative_errors(*mesh, repainted_by_hand, *painted_B));
  state(fmt::format("paint changes the light by {:.3f}, and the same U and V follow it to {:.3f}",
                    painted_change, painted_error),
        painted_change > 0.08 && painted_error <= 1.5 * uniform_error);

  const std::string live_spec = "svd:k=96,norm=area,storage=f64";
  const auto live = cpu_operators().make(live_spec, form_factors);
  const auto solver = cpu_solvers().make("woodbury", {*live, mesh->area.cwiseSqrt(), {.tolerance = 1e-10}});
  solve(*solver, E);
  dynamic_cast<KernelOperator&>(*live).set_reflectance(painted);
  const Field repainted = solve(*solver, E);
  const auto rebuilt = cpu_operators().make(live_spec, painted_room);
  const Field from_scratch =
      solve(*cpu_solvers().make("woodbury", {*rebuilt, mesh->area.cwiseSqrt(), {.tolerance = 1e-10}}), E);
  const double live_difference = (repainted - from_scratch).norm() / from_scratch.norm();
  state(fmt::format("painted or built anew: a difference of {:.0e}", live_difference),
        live_difference <= 1e-12);

  // %% tags=["program"]
  return all_facts_hold ? 0 : 1;
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}

// %% [markdown]
// # From residual to certificate
//
// A solver knows its residual, an engineer wants the error. Between the two stands how long light survives:
// in a room that reflects 99 %, a residual may stand for an error a hundred times as large, or for one as
// small as itself. This notebook turns the residual of any answer into a bound on its error that is right and
// tight.
//
// The cells below are also a program: `notebook_02_from_residual_to_certificate FOLDER` writes its plots into
// FOLDER, prints what it finds, and fails if one of the facts that it states is wrong.

// %%
#include "experiments/svg_plot.hpp"
#include "form_factors/form_factors.hpp"
#include "operators/kernel_operator.hpp"
#include "operators/operator_registry.hpp"
#include "operators/rooms.hpp"
#include "scene/built_in.hpp"
#include "scene/patch_mesh.hpp"
#include "solvers/error_certificate.hpp"
#include "solvers/solver_registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

using namespace radiosity;

bool all_facts_hold = true;

PlotPoint point(double x, double y) {
  return {x, std::max(y, 1e-16), 0, ""};
}

void state(const std::string& fact, bool holds) {
  fmt::print("{}: {}\n", holds ? "true " : "FALSE", fact);
  all_facts_hold = all_facts_hold && holds;
}

// %% tags=["program"]
int main(int argc, char** argv) try {
  const std::filesystem::path folder = argc > 1 ? argv[1] : ".";

  // %% tags=["notebook"]
  // const std::filesystem::path folder = ".";

  // %% [markdown]
  // ## Two rooms and a door
  //
  // Two unit rooms joined by a door 0.3 wide, walls that reflect 99 %. Light has two slow modes: both rooms
  // bright, which loses 1 % a bounce, and one bright at the expense of the other, which also leaks through
  // the door. The kernel alone tells that there are two rooms: F has as many eigenvalues near 1.

  // %%
  std::filesystem::create_directories(folder);
  const auto mesh = std::make_shared<const PatchMesh>(
      make_patches(built_in_scene("rooms:n=2,door=0.3,reflectance=0.99"), {.patches = 400}));
  SilentMonitor monitor;
  const FormFactors form_factors = compute_form_factors(mesh, {}, monitor);
  const Rooms rooms = find_rooms(form_factors);
  state(fmt::format("{} patches fall into {} rooms", form_factors.patch_count(), rooms.count),
        rooms.count == 2);

  // %% [markdown]
  // ## The certificate
  //
  // It finds the slow modes once: eigenvectors of S = R^{1/2} K R^{1/2} until the rest decays quickly, and a
  // bound on the rest. A residual along a slow mode is then divided by what that mode loses in a bounce, and
  // only the rest by the bound for the rest.

  // %%
  const auto transport = cpu_operators().make("dense", form_factors);
  const auto& truth = dynamic_cast<const KernelOperator&>(*transport);
  const ErrorCertificate certificate(truth);
  state(fmt::format("{} modes were taken out, with {:.0f} products", certificate.vectors(),
                    certificate.products()),
        certificate.vectors() >= 2);

  // %% [markdown]
  // ## Stopped early
  //
  // Conjugate gradients, step by step: the true error, what the residual alone would promise, and the
  // certificate. The residual alone is divided by 1 - 0.99, as if all of it were in the slowest mode.

  // %%
  SolverOptions exact;
  exact.tolerance = 1e-13;
  const SolverProblem problem{*transport, mesh->area.cwiseSqrt(), exact};
  const Field B = solve(*cpu_solvers().make("cg", problem), mesh->emission);
  const double size = area_norms(problem.root_area, B).norm();

  PlotSeries error_series{.name = "error", .points = {}};
  PlotSeries residual_series{.name = "residual / (1 - reflectance)", .points = {}};
  PlotSeries bound_series{.name = "certificate", .points = {}};
  double loosest = 0, tightest = 1e300, loosest_residual = 0;
  const auto solver = cpu_solvers().make("neumann", {*transport, problem.root_area, {.tolerance = 1e-4}});
  solver->start(mesh->emission);
  for (int step = 1; !solver->converged(); ++step) {
    solver->step();
    if (step % 20 != 0) continue;
    const double error = area_norms(problem.root_area, Field(solver->radiosity() - B)).norm();
    const double bound = certificate.bound(mesh->emission, solver->radiosity()).absolute.norm();
    const double from_residual =
        solver->residual() * area_norms(problem.root_area, mesh->emission).norm() / (1 - 0.99);
    error_series.points.push_back(point(step, error / size));
    residual_series.points.push_back(point(step, from_residual / size));
    bound_series.points.push_back(point(step, bound / size));
    loosest = std::max(loosest, bound / error);
    tightest = std::min(tightest, bound / error);
    loosest_residual = std::max(loosest_residual, from_residual / error);
  }
  state(fmt::format("the certificate holds: {:.3f} times the error at least", tightest), tightest >= 1);
  state(fmt::format("and is tight: {:.3f} times at most", loosest), loosest <= 4);
  fmt::print("       the residual alone: up to {:.2f} times\n", loosest_residual);

  // %% [markdown]
  // ## Any answer
  //
  // The certificate asks nothing of where an answer comes from. Half-precision storage is off by 2e-4 in
  // every entry; closed, it is right on what matters. The residual alone is of no use here: its part in the
  // slow modes is small, so that it promises far too little precision.

  // %%
  for (const std::string spec : {"dense:f16", "dense:f16,closure=symmetric", "dense:f16,closure=blocks"}) {
    const auto stored = cpu_operators().make(spec, form_factors);
    const Field answer =
        solve(*cpu_solvers().make("cg", {*stored, problem.root_area, {.tolerance = 1e-6}}), mesh->emission);
    const double error = area_norms(problem.root_area, Field(answer - B)).norm();
    const double bound = certificate.bound(mesh->emission, answer).absolute.norm();
    Field image(answer.rows(), answer.cols());
    transport->apply(answer, image);
    const double residual = area_norms(problem.root_area, Field(mesh->emission + image - answer)).norm();
    fmt::print("       {:<28} error {:.1e}, certificate {:.1e}, residual alone {:.1e}\n", spec, error / size,
               bound / size, residual / (1 - 0.99) / size);
    state(fmt::format("{} is certified within a factor of 4", spec), error <= bound && bound <= 4 * error);
  }

  // %% [markdown]
  // ## Forgetting a mode
  //
  // With one vector for two rooms the bound is still right, since the bound on the rest knows of the other
  // slow mode. But it is of little use.

  // %%
  ErrorCertificateOptions one_vector;
  one_vector.most_vectors = 1;
  const ErrorCertificate poor(truth, one_vector);
  Field wrong = B;
  wrong.col(0).head(5) *= 1.1;
  const double error = area_norms(problem.root_area, Field(wrong - B)).norm();
  const double with_all = certificate.bound(mesh->emission, wrong).absolute.norm() / error;
  const double with_one = poor.bound(mesh->emission, wrong).absolute.norm() / error;
  state(fmt::format("bound / error is {:.2f} with all slow modes and {:.1f} with one", with_all, with_one),
        with_all >= 1 && with_all <= 4 && with_one > 4);

  Plot plot;
  plot.title = "Neumann's series in two rooms, reflectance 0.99";
  plot.panels.push_back({.title = "",
                         .x = {.label = "bounces"},
                         .y = {.label = "relative to ||B||", .scale = Scale::logarithmic},
                         .series = {residual_series, bound_series, error_series}});
  write_svg(folder / "certificate.svg", plot);

  // %% tags=["program"]
  return all_facts_hold ? 0 : 1;
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}

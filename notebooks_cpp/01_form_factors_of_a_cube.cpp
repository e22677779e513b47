// %% [markdown]
// # Form factors of a cube
//
// The inside of a unit cube is the smallest room: convex, so that nothing blocks a ray, and closed, so that
// no light gets lost. Its matrix of form factors F shows what makes radiosity easy: rows that sum to 1, one
// large eigenvalue that stands alone, and iterations that need a dozen products.
//
// The cells below are also a program: `notebook_01_form_factors_of_a_cube FOLDER` writes its plots into
// FOLDER, prints what it finds, and fails if one of the facts that it states is wrong.

// %%
#include "experiments/svg_plot.hpp"
#include "form_factors/form_factors.hpp"
#include "operators/operator_registry.hpp"
#include "scene/built_in.hpp"
#include "scene/patch_mesh.hpp"
#include "solvers/solver_registry.hpp"

#include <fmt/format.h>
#include <lapacke.h>

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
  return {x, y, 0, ""};
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
  // ## The matrix
  //
  // Each face is cut into 8 x 8 squares: n = 384 patches. Reciprocity, A_i F_ij = A_j F_ji, allows to keep
  // the symmetric kernel K = A^{1/2} F A^{-1/2} instead of F; all patches have the same area here, so that K
  // and F are the same matrix.

  // %%
  std::filesystem::create_directories(folder);
  const auto mesh = std::make_shared<const PatchMesh>(make_patches(built_in_scene("cube"), {.patches = 384}));
  SilentMonitor monitor;
  FormFactorOptions options;
  options.closure = Closure::none;  // to see the rows as they were integrated
  const FormFactors form_factors = compute_form_factors(mesh, options, monitor);
  const Eigen::Index n = form_factors.patch_count();
  state(fmt::format("there are {} patches", n), n == 384);

  // %% [markdown]
  // ## Row sums
  //
  // F_ij is the fraction of what leaves patch i and arrives at j. In a closed room everything arrives
  // somewhere.

  // %%
  const Eigen::VectorXd row_sums = form_factors.row_sums();
  const double row_error = (row_sums.array() - 1).abs().maxCoeff();
  state(fmt::format("rows sum to 1 up to {:.1e}", row_error), row_error <= 1e-6);

  Plot row_sum_plot;
  row_sum_plot.title = "Row sums of F, cube, n = 384";
  PlotSeries row_series{.name = "row sum - 1", .points = {}, .line = false};
  for (Eigen::Index i = 0; i < n; ++i)
    row_series.points.push_back(point(static_cast<double>(i), row_sums[i] - 1));
  row_sum_plot.panels.push_back(
      {.title = "", .x = {.label = "patch"}, .y = {.label = "row sum - 1"}, .series = {row_series}});
  write_svg(folder / "row_sums.svg", row_sum_plot);

  // %% [markdown]
  // ## Spectrum
  //
  // K is symmetric: its eigenvalues are real. The largest is 1, with the constant field as its eigenvector
  // (even light stays even light), and it stands alone: nothing else survives a bounce by more than half. The
  // others fall slowly, since patches along an edge see more of each other than of the room. Their sum is the
  // trace, which is 0: no flat patch sees itself.

  // %%
  Eigen::MatrixXd kernel = materialize(*form_factors.kernel);
  const double trace = kernel.trace();
  Eigen::VectorXd eigenvalues(n);
  const lapack_int status = LAPACKE_dsyev(LAPACK_COL_MAJOR, 'N', 'U', static_cast<lapack_int>(n),
                                          kernel.data(), static_cast<lapack_int>(n), eigenvalues.data());
  state("the eigenvalues were found", status == 0);
  std::vector<double> magnitudes(eigenvalues.begin(), eigenvalues.end());
  for (double& magnitude : magnitudes) magnitude = std::abs(magnitude);
  std::sort(magnitudes.rbegin(), magnitudes.rend());
  const auto large =
      std::count_if(magnitudes.begin(), magnitudes.end(), [](double value) { return value > 0.1; });
  state(fmt::format("the largest eigenvalue is {:.9f}", eigenvalues[n - 1]),
        std::abs(eigenvalues[n - 1] - 1) <= 1e-6);
  state(fmt::format("the next in size is {:.3f}", magnitudes[1]), magnitudes[1] < 0.5);
  state(fmt::format("the trace is {:.1e}, the sum of the eigenvalues {:.1e}", trace, eigenvalues.sum()),
        trace == 0 && std::abs(eigenvalues.sum()) <= 1e-10);
  state(fmt::format("{} of {} eigenvalues are larger than 0.1", large, n), large < n / 2);

  Plot spectrum_plot;
  spectrum_plot.title = "Spectrum of K, cube, n = 384";
  PlotSeries spectrum{.name = "|eigenvalue|", .points = {}, .markers = false};
  for (std::size_t k = 0; k < magnitudes.size(); ++k)
    spectrum.points.push_back(point(static_cast<double>(k + 1), std::max(magnitudes[k], 1e-16)));
  spectrum_plot.panels.push_back({.title = "",
                                  .x = {.label = "number"},
                                  .y = {.label = "|eigenvalue|", .scale = Scale::logarithmic, .low = 1e-8},
                                  .series = {spectrum}});
  write_svg(folder / "spectrum.svg", spectrum_plot);

  // %% [markdown]
  // ## Convergence
  //
  // B = E + T B with T = 0.5 F: the walls reflect half of the light, the ceiling emits 1 W/m^2. Neumann's
  // series adds one bounce a product and gains a factor of 2 each. Gauss-Seidel uses what it has just
  // computed. Conjugate gradients deal with the one large eigenvalue first, and gain a factor of 8 or so with
  // each product.

  // %%
  const auto transport = cpu_operators().make("dense", form_factors);
  SolverOptions solver_options;
  solver_options.tolerance = 1e-10;
  Plot convergence_plot;
  convergence_plot.title = "Convergence, cube, n = 384, reflectance 0.5";
  PlotPanel convergence{.title = "",
                        .x = {.label = "step"},
                        .y = {.label = "relative residual", .scale = Scale::logarithmic, .low = 1e-12},
                        .series = {}};
  std::vector<std::size_t> steps;
  std::vector<Field> solutions;
  for (const std::string name : {"neumann", "gauss-seidel", "cg"}) {
    const auto solver = cpu_solvers().make(name, {*transport, mesh->area.cwiseSqrt(), solver_options});
    PlotSeries history{.name = name, .points = {}};
    solver->start(mesh->emission);
    while (!solver->converged()) {
      solver->step();
      history.points.push_back(
          point(static_cast<double>(history.points.size() + 1), std::max(solver->residual(), 1e-16)));
    }
    fmt::print("       {:<12} {:>2} steps to a residual of {:.1e}\n", name, history.points.size(),
               solver->residual());
    steps.push_back(history.points.size());
    solutions.push_back(solver->radiosity());
    convergence.series.push_back(history);
  }
  convergence_plot.panels.push_back(convergence);
  write_svg(folder / "convergence.svg", convergence_plot);

  const double disagreement =
      std::max((solutions[0] - solutions[2]).norm(), (solutions[1] - solutions[2]).norm());
  state(fmt::format("the three agree to {:.1e}", disagreement / solutions[2].norm()),
        disagreement <= 1e-8 * solutions[2].norm());
  state("Gauss-Seidel needs fewer steps than Neumann, conjugate gradients fewer than Gauss-Seidel",
        steps[1] < steps[0] && steps[2] < steps[1]);
  const double emitted = mesh->area.dot(mesh->emission.col(0));
  const Eigen::VectorXd reflected =
      (solutions[2] - mesh->emission).col(0);  // rho H = H / 2, and 1 - rho = 1 / 2 is absorbed
  const double absorbed = mesh->area.dot(reflected);
  state(fmt::format("of {:.3f} W emitted {:.3f} W are absorbed", emitted, absorbed),
        std::abs(absorbed - emitted) <= 1e-6);

  // %% tags=["program"]
  return all_facts_hold ? 0 : 1;
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}

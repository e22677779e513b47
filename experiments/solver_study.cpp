#include "experiments/solver_study.hpp"

#include "experiments/json_objects.hpp"
#include "experiments/svg_plot.hpp"
#include "form_factors/form_factors.hpp"
#include "foundation/output_file.hpp"
#include "foundation/stopwatch.hpp"
#include "scene/built_in.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace radiosity {

namespace {

constexpr const char* corrected = "cg:preconditioner=quantized";

/// All registered solvers at their defaults, the corrected one after cg.
std::vector<std::string> studied_solvers(const SolverRegistry& solvers) {
  std::vector<std::string> specs;
  for (const SolverEntry& entry : solvers.entries()) {
    specs.push_back(entry.name);
    if (entry.name == "cg") specs.emplace_back(corrected);
  }
  return specs;
}

FormFactors chain_of_rooms(int rooms, const SolverStudyOptions& options, Monitor& monitor) {
  const Scene scene = built_in_scene(fmt::format("rooms:n={},door=0.3", rooms));
  const auto mesh =
      std::make_shared<const PatchMesh>(make_patches(scene, {.patches = rooms * options.patches_a_room}));
  return compute_form_factors(mesh, {.seed = options.seed}, monitor);
}

FormFactors with_reflectance(const FormFactors& form_factors, double reflectance) {
  FormFactors changed = form_factors;
  auto mesh = std::make_shared<PatchMesh>(*form_factors.mesh);
  mesh->reflectance.setConstant(reflectance);
  changed.mesh = std::move(mesh);
  return changed;
}

SolverRun run_solver(const FormFactors& form_factors, const std::string& spec,
                     const SolverStudyOptions& options, const OperatorRegistry& operators,
                     const SolverRegistry& solvers) {
  SolverRun run;
  run.solver = spec;
  run.patches = form_factors.patch_count();
  const auto transport = operators.make(solvers.exact_operator(spec), form_factors);
  const Stopwatch watch;
  try {
    const auto solver =
        solvers.make(spec, {*transport,
                            form_factors.mesh->area.cwiseSqrt(),
                            {.tolerance = options.tolerance, .max_products = options.max_products},
                            [&](const std::string& other) { return operators.make(other, form_factors); }});
    solve(*solver, form_factors.mesh->emission);
    run.products = solver->products();
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    run.refusal = error.what();
  }
  run.seconds = watch.seconds();
  return run;
}

std::string products_text(const SolverRun& run) {
  return run.products ? std::to_string(*run.products) : "refused";
}

/// Runs of one chain, one line a solver, one column a reflectance.
ReportTable products_table(const std::vector<SolverRun>& runs, int rooms, const std::string& command) {
  ReportTable table;
  std::set<double> reflectances;
  Index patches = 0;
  for (const SolverRun& run : runs) {
    if (run.rooms != rooms) continue;
    reflectances.insert(run.reflectance);
    patches = run.patches;
  }
  table.caption = fmt::format("{} room{}, {} patches: products with the true operator (milliseconds).", rooms,
                              rooms == 1 ? "" : "s", patches);
  table.command = command;
  table.columns = {"solver"};
  for (const double reflectance : reflectances) table.columns.push_back(fmt::format("ρ = {}", reflectance));
  for (const SolverRun& run : runs) {
    if (run.rooms != rooms) continue;
    if (table.rows.empty() || table.rows.back().front() != run.solver) table.rows.push_back({run.solver});
    table.rows.back().push_back(run.products ? fmt::format("{} ({:.3g})", *run.products, 1e3 * run.seconds)
                                             : products_text(run));
  }
  return table;
}

PlotPanel products_panel(const std::vector<SolverRun>& runs, int rooms) {
  PlotPanel panel;
  panel.title = fmt::format("{} room{}", rooms, rooms == 1 ? "" : "s");
  panel.x = {"1 / (1 − reflectance)", Scale::logarithmic};
  panel.y = {"products to the tolerance", Scale::logarithmic};
  for (const SolverRun& run : runs) {
    if (run.rooms != rooms || !run.products || *run.products == 0) continue;
    auto series = std::find_if(panel.series.begin(), panel.series.end(),
                               [&](const PlotSeries& known) { return known.name == run.solver; });
    if (series == panel.series.end()) series = panel.series.insert(series, {run.solver, {}});
    series->points.push_back({1 / (1 - run.reflectance), static_cast<double>(*run.products), 0, ""});
  }
  return panel;
}

void write_solver_files(const std::filesystem::path& folder, const std::vector<SolverRun>& runs) {
  Json list = Json::array();
  std::string csv = "rooms,patches,reflectance,solver,products,seconds\n";
  for (const SolverRun& run : runs) {
    list.push_back({{"rooms", run.rooms},
                    {"patches", run.patches},
                    {"reflectance", run.reflectance},
                    {"solver", run.solver},
                    {"products", run.products ? Json(*run.products) : Json()},
                    {"seconds", run.seconds},
                    {"refusal", run.refusal.empty() ? Json() : Json(run.refusal)}});
    csv += fmt::format("{},{},{},\"{}\",{},{:.6g}\n", run.rooms, run.patches, run.reflectance, run.solver,
                       run.products ? std::to_string(*run.products) : "", run.seconds);
  }
  write_json(folder / "solvers.json", {{"runs", list}});
  OutputFile table(folder / "solvers.csv");
  table.stream() << csv;
  table.commit();
}

}  // namespace

std::vector<SolverRun> measure_solvers(const SolverStudyOptions& options, const OperatorRegistry& operators,
                                       const SolverRegistry& solvers, Monitor& monitor) {
  std::vector<SolverRun> runs;
  const std::vector<std::string> specs = studied_solvers(solvers);
  for (const int rooms : options.rooms) {
    const FormFactors chain = chain_of_rooms(rooms, options, monitor);
    for (const std::string& spec : specs) {
      for (const double reflectance : options.reflectances) {
        monitor.checkpoint(fmt::format("{} on {} rooms", spec, rooms), reflectance);
        SolverRun run = run_solver(with_reflectance(chain, reflectance), spec, options, operators, solvers);
        run.rooms = rooms;
        run.reflectance = reflectance;
        runs.push_back(std::move(run));
      }
    }
  }
  return runs;
}

ReportSection solver_section(const std::vector<SolverRun>& runs, const SolverStudyOptions& options,
                             const std::string& command) {
  ReportSection section{"Solvers: products over reflectance and rooms", {}};
  std::set<std::string> refusals;
  for (const SolverRun& run : runs)
    if (!run.refusal.empty()) refusals.insert(run.refusal);
  section.blocks.emplace_back(
      ReportText{fmt::format("Chains of unit rooms joined by doors 0.3 wide, lit from the ceiling of the "
                             "first, solved to a relative residual "
                             "of {:.0e} with at most {} products. Light that survives many bounces in many "
                             "rooms takes stationary iterations "
                             "thousands of products, conjugate gradients a few for each room, and, corrected "
                             "by a solution with a compressed "
                             "operator that is right on each room's uniform light, a handful.",
                             options.tolerance, options.max_products)});
  Plot plot;
  for (const int rooms : options.rooms) {
    section.blocks.emplace_back(products_table(runs, rooms, command));
    if (rooms == options.rooms.front() || rooms == options.rooms.back())
      plot.panels.push_back(products_panel(runs, rooms));
  }
  section.blocks.emplace_back(ReportFigure{
      "Products with the true operator; solvers that refused are left out.", command, to_svg(plot)});
  for (const std::string& refusal : refusals) section.blocks.emplace_back(ReportText{"Refused: " + refusal});
  return section;
}

ReportSection solver_study(const std::filesystem::path& folder, const std::string& command,
                           const SolverStudyOptions& options, const OperatorRegistry& operators,
                           const SolverRegistry& solvers, Monitor& monitor) {
  make_folder(folder);
  const std::vector<SolverRun> runs = measure_solvers(options, operators, solvers, monitor);
  write_solver_files(folder, runs);
  return solver_section(runs, options, command);
}

}  // namespace radiosity

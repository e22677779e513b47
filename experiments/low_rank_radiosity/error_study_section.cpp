// Tables and plots of `low-rank-errors`.

#include "experiments/low_rank_radiosity/error_study_findings.hpp"
#include "experiments/svg_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <utility>

namespace radiosity {
namespace {

constexpr const char* best_name = "best of rank k";
constexpr double panel_width = 520;
constexpr double panel_height = 460;

std::string short_number(double value) {
  return value == 0 ? "0" : fmt::format("{:.1e}", value);
}

std::string ratio_to_bound(const ErrorStudy& study, const LowRankError& row) {
  const BestRankError* bound = study.bound(row.problem, row.rank);
  if (!row.errors || bound == nullptr || bound->errors.radiosity_rms <= 0) return "–";
  return fmt::format("{:.3g}", row.errors->radiosity_rms / bound->errors.radiosity_rms);
}

std::vector<std::string> error_cells(const std::optional<LightErrors>& errors) {
  if (!errors) return {"refused", "–", "–", "–"};
  return {short_number(errors->radiosity_mean), short_number(errors->radiosity_max),
          short_number(errors->indirect_mean), short_number(errors->indirect_max)};
}

void append(std::vector<std::string>& row, const std::vector<std::string>& cells) {
  row.insert(row.end(), cells.begin(), cells.end());
}

ReportTable error_table(const ErrorStudy& study, const ErrorStudyProblem& problem,
                        const std::string& command) {
  ReportTable table;
  table.caption =
      problem.text() +
      ". Relative errors weighted by area; the last column compares the root mean square over the "
      "lights with that of the best operator of the same rank.";
  table.command = command;
  table.columns = {"factorization", "k",           "rank",     "bytes a patch", "error in T", "in B",
                   "largest",       "in indirect", "largest ", "radius",        "over best"};
  for (const LowRankError& row : study.factorizations) {
    if (row.problem != problem) continue;
    std::vector<std::string> cells = {row.factorization, std::to_string(row.k), std::to_string(row.rank),
                                      fmt::format("{:.0f}", row.bytes_per_patch),
                                      short_number(row.operator_error)};
    append(cells, error_cells(row.errors));
    append(cells, {fmt::format("{:.4f}", row.spectral_radius), ratio_to_bound(study, row)});
    table.rows.push_back(std::move(cells));
  }
  for (const BestRankError& bound : study.bounds) {
    if (bound.problem != problem) continue;
    std::vector<std::string> cells = {best_name, std::to_string(bound.rank), std::to_string(bound.rank), "–",
                                      "–"};
    append(cells, error_cells(bound.errors));
    append(cells, {"–", "1"});
    table.rows.push_back(std::move(cells));
  }
  return table;
}

using Coordinate = std::function<double(const LowRankError&)>;

double rank_of(const LowRankError& row) {
  return static_cast<double>(row.rank);
}

double mean_error_of(const LowRankError& row) {
  return row.errors->radiosity_mean;
}

/// A line for each factorization.
std::vector<PlotSeries> error_series(const ErrorStudy& study, const ErrorStudyProblem& problem,
                                     const Coordinate& x, const Coordinate& y = mean_error_of) {
  std::vector<PlotSeries> all;
  for (const LowRankError& row : study.factorizations) {
    if (row.problem != problem || !row.errors || x(row) <= 0 || y(row) <= 0) continue;
    auto series = std::find_if(all.begin(), all.end(),
                               [&](const PlotSeries& known) { return known.name == row.factorization; });
    if (series == all.end()) series = all.insert(series, {row.factorization, {}});
    series->points.push_back({x(row), y(row), 0, ""});
  }
  return all;
}

PlotSeries bound_series(const ErrorStudy& study, const ErrorStudyProblem& problem,
                        const std::function<double(const BestRankError&)>& error) {
  PlotSeries series{best_name, {}};
  for (const BestRankError& bound : study.bounds)
    if (bound.problem == problem && error(bound) > 0)
      series.points.push_back({static_cast<double>(bound.rank), error(bound), 0, ""});
  return series;
}

PlotPanel error_panel(const std::string& title, const std::string& x_label, std::vector<PlotSeries> series) {
  PlotPanel panel;
  panel.title = title;
  panel.x = {x_label, Scale::logarithmic};
  panel.y = {"mean relative error in B", Scale::logarithmic};
  panel.series = std::move(series);
  return panel;
}

ReportFigure error_figure(const ErrorStudy& study, const ErrorStudyProblem& problem,
                          const std::string& command) {
  std::vector<PlotSeries> over_rank = error_series(study, problem, rank_of);
  over_rank.push_back(
      bound_series(study, problem, [](const BestRankError& bound) { return bound.errors.radiosity_mean; }));
  Plot plot;
  plot.title = problem.text();
  plot.panels = {
      error_panel("Error in B over rank", "rank", std::move(over_rank)),
      error_panel("Error in B over error in T", "relative error in T",
                  error_series(study, problem, [](const LowRankError& row) { return row.operator_error; })),
      error_panel("Error in B over bytes", "bytes a patch",
                  error_series(study, problem, [](const LowRankError& row) { return row.bytes_per_patch; }))};
  plot.panel_width = panel_width;
  plot.panel_height = panel_height;
  return {
      "Each point is one k. The best of rank k was found with other lights of the same kinds: averaged over "
      "all such lights nothing of rank k has a smaller root mean square error; these are a sample.",
      command, to_svg(plot)};
}

/// Error in B over rank for lights of one kind, beside the best operator for such lights alone.
ReportFigure kinds_figure(const ErrorStudy& study, const ErrorStudyProblem& problem,
                          const std::string& command) {
  constexpr std::array<const char*, 3> titles = {"Area lights", "Point lights", "Single patches"};
  Plot plot;
  plot.title = problem.text();
  plot.panel_width = panel_width;
  plot.panel_height = panel_height;
  for (std::size_t kind = 0; kind < titles.size(); ++kind) {
    std::vector<PlotSeries> lines = error_series(study, problem, rank_of, [kind](const LowRankError& row) {
      return row.errors->of_kind[kind].value_or(0);
    });
    if (lines.empty()) continue;
    lines.push_back(bound_series(
        study, problem, [kind](const BestRankError& bound) { return bound.alone[kind].value_or(0); }));
    plot.panels.push_back(error_panel(titles[kind], "rank", std::move(lines)));
  }
  return {"The same by kind of light; the best of rank k is here that for lights of this kind alone.",
          command, to_svg(plot)};
}

/// The values at numbers that grow by a factor, as a logarithmic axis spreads them.
PlotSeries spectrum_series(const std::string& name, const std::vector<double>& values) {
  constexpr double below_interest = 1e-8;
  constexpr double growth = 1.08;
  PlotSeries series{name, {}};
  series.markers = false;
  for (std::size_t number = 1; number <= values.size() && values[number - 1] > below_interest;
       number = std::max(number + 1, static_cast<std::size_t>(growth * static_cast<double>(number))))
    series.points.push_back({static_cast<double>(number), values[number - 1], 0, ""});
  return series;
}

ReportFigure spectrum_figure(const ErrorStudy& study, const std::string& command) {
  Plot plot;
  plot.panel_height = panel_height;
  for (const SpectrumStudy& spectrum : study.spectra) {
    PlotPanel panel;
    panel.title = fmt::format("{}, {} patches", spectrum.scene, spectrum.patches);
    panel.x = {"number of the value", Scale::logarithmic};
    panel.y = {"magnitude", Scale::logarithmic};
    panel.series = {spectrum_series("singular values of F", spectrum.singular_values),
                    spectrum_series("eigenvalues of K", spectrum.eigenvalues),
                    spectrum_series("K without pairs that share an edge", spectrum.without_adjacent)};
    plot.panels.push_back(std::move(panel));
  }
  return {
      "F = T at reflectance 1; K = A^1/2 F A^-1/2. The shelf before the fall goes with the pairs of "
      "patches that share an edge.",
      command, to_svg(plot)};
}

std::string fitted(const std::optional<double>& exponent) {
  return exponent ? fmt::format("{:.2f}", *exponent) : "–";
}

ReportTable findings_table(const std::vector<ProblemFindings>& findings, const std::string& command) {
  ReportTable table;
  table.caption =
      "Problem by problem: at how many k SVD is beaten in B by a factorization of no larger rank, and by "
      "whom; its rms error over the best of rank k; its mean error at the largest k over that of the best of "
      "rank k for one kind of light alone.";
  table.command = command;
  table.columns = {"problem",       "SVD beaten",    "strongest rival", "gain",
                   "SVD over best", "of area alone", "of point alone",  "of patch alone"};
  for (const ProblemFindings& one : findings) {
    std::vector<std::string> row = {
        one.problem.text(), fmt::format("{} of {}", one.svd_beaten_in_B, one.ranks),
        one.svd_beaten_in_B > 0
            ? fmt::format("{}, k = {:.0f}", one.strongest_rival.factorization, one.strongest_rival.cost)
            : "–",
        fmt::format("{:.2f}", one.largest_gain),
        fmt::format("{:.2g} … {:.2g}", one.svd_over_best_low, one.svd_over_best_high)};
    for (const double ratio : one.svd_over_alone) row.push_back(fmt::format("{:.2g}", ratio));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Exponents of every factorization on every problem.
ReportTable decay_table(const std::vector<ProblemFindings>& findings, const std::string& command) {
  ReportTable table;
  table.caption =
      "How the mean error in B falls: exponents fitted over all k, and the error in T over the error in B at "
      "the largest k.";
  table.command = command;
  table.columns = {"problem", "factorization", "over k", "over error in T", "error in T above B"};
  table.text_columns = 2;
  for (const ProblemFindings& one : findings)
    for (const ErrorDecay& decay : one.decays)
      table.rows.push_back({one.problem.text(), decay.factorization, fitted(decay.over_rank),
                            fitted(decay.over_operator_error),
                            fmt::format("{:.3g}", decay.below_operator_error)});
  return table;
}

}  // namespace

ReportSection error_study_section(const ErrorStudy& study, const std::string& command) {
  ReportSection section{"Low rank: the error in T and the error in B", {}};
  for (const std::string& answer : answers(study)) section.blocks.emplace_back(ReportText{answer});
  const std::vector<ProblemFindings> findings = find_in_study(study);
  section.blocks.emplace_back(findings_table(findings, command));
  section.blocks.emplace_back(decay_table(findings, command));
  section.blocks.emplace_back(spectrum_figure(study, command));
  for (const ErrorStudyProblem& problem : study.problems()) {
    section.blocks.emplace_back(error_figure(study, problem, command));
    section.blocks.emplace_back(kinds_figure(study, problem, command));
    section.blocks.emplace_back(error_table(study, problem, command));
  }
  return section;
}

}  // namespace radiosity

#include "experiments/dxt_radiosity/dxt_errors.hpp"
#include "experiments/dxt_radiosity/dxt_errors_findings.hpp"
#include "experiments/dxt_radiosity/published_errors.hpp"
#include "experiments/svg_plot.hpp"
#include "operators/bounce_sums.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace radiosity {
namespace {

PlotSeries bins_series(const Histogram& histogram, bool above_zero) {
  PlotSeries series{.name = "entries", .points = {}, .markers = false};
  for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin)
    if (!above_zero || histogram.counts[bin] > 0)
      series.points.push_back({histogram.centre(bin), static_cast<double>(histogram.counts[bin]), 0, ""});
  return series;
}

PlotPanel histogram_panel(const std::string& title, const std::string& label, const Histogram& histogram,
                          Scale scale) {
  return {.title = title,
          .x = {.label = label},
          .y = {.label = "entries", .scale = scale},
          .series = {bins_series(histogram, scale == Scale::logarithmic)}};
}

ReportFigure factors_figure(const EntryHistograms& histograms, const std::string& command) {
  Plot plot;
  plot.title = "Form factors";
  plot.panels = {histogram_panel("linear", "F", histograms.factors, Scale::linear),
                 histogram_panel("logarithmic count", "F", histograms.factors, Scale::logarithmic),
                 histogram_panel("logarithm of F", "log10 F", histograms.logarithms, Scale::logarithmic)};
  plot.panel_width = 320;
  plot.panel_height = 240;
  return {fmt::format("Figure 1: how many of the {} form factors are how large. {} are zero or below 1e-12.",
                      histograms.factors.total(), histograms.logarithms.below),
          command, to_svg(plot)};
}

ReportFigure codes_figure(const EntryHistograms& histograms, const std::string& command) {
  Plot plot;
  plot.title = "Logarithms and codes";
  plot.panels = {histogram_panel("Figure 3", "ln(F^c / largest)", histograms.normalized, Scale::linear),
                 histogram_panel("Figure 4", "code", histograms.codes, Scale::logarithmic)};
  plot.panel_height = 240;
  return {
      fmt::format("Figures 3 and 4: entries of F^c, all channels, without the exact 4 %: logarithms after "
                  "division by the channel's largest ({} of {} are exact, zero or below -30), and final "
                  "codes, 0 for what is exact or zero.",
                  histograms.normalized.below, histograms.normalized.total()),
      command, to_svg(plot)};
}

/// The document's column of a row that starts in a random order, the one without any order of its own.
const PublishedErrors* published_column(const TexelOrderChoice& order) {
  if (order.start != "random") return nullptr;
  const auto* column = std::find_if(std::begin(published_errors), std::end(published_errors),
                                    [&](const PublishedErrors& own) { return order.reorder == own.reorder; });
  return column == std::end(published_errors) ? nullptr : column;
}

std::string reordering_text(const TexelOrderChoice& order) {
  if (order.reorder == "morton") return "curves on the faces";
  std::string start = order.start == "random" ? "random" : "faces";
  if (order.reorder == "none") return start;
  if (order.reorder == "rows") return start + ", by rows";
  if (order.reorder == "both") return start + ", by rows and columns";
  return start + ", by rows and 2-opt";
}

ReportTable reordering_table(const DxtErrors& errors, const std::string& command) {
  ReportTable table{
      .caption = fmt::format("Figure 7: errors of the compressed F^c over all entries and channels ({}, {} "
                             "patches), and the document's for its own scene.",
                             errors.scene, errors.patches),
      .command = command,
      .columns = {"order", "average", "maximum", "total", "gain", "bytes an entry", "document: average",
                  "maximum", "total", "gain"},
      .rows = {}};
  for (const ReorderingRow& row : errors.reorderings) {
    const double gain = errors.reordering(row.order.start, "none").errors.total / row.errors.total;
    std::vector<std::string> cells = {reordering_text(row.order),
                                      fmt::format("{:.2e}", row.errors.average),
                                      fmt::format("{:.2e}", row.errors.largest),
                                      fmt::format("{:.2f}", row.errors.total),
                                      fmt::format("{:.2f}", gain),
                                      fmt::format("{:.3f}", row.bytes_per_entry)};
    if (const PublishedErrors* column = published_column(row.order))
      cells.insert(cells.end(), {fmt::format("{:.2e}", column->average), fmt::format("{}", column->largest),
                                 fmt::format("{:.2f}", column->total),
                                 fmt::format("{:.2f}", published_errors[0].total / column->total)});
    else
      cells.insert(cells.end(), 4, "–");
    table.rows.push_back(std::move(cells));
  }
  return table;
}

ReportTable exact_part_table(const DxtErrors& errors, const std::string& command) {
  ReportTable table{.caption = "Figure 2: total error over the part of each row and channel that is exact.",
                    .command = command,
                    .columns = {"exact", "order of faces", "rows and columns", "improved"},
                    .rows = {}};
  for (const ExactPartRow& row : errors.exact_parts)
    table.rows.push_back({fmt::format("{:.0f} %", 100 * row.exact), fmt::format("{:.2f}", row.without_order),
                          fmt::format("{:.2f}", row.ordered), fmt::format("{:.2f}", row.filled)});
  return table;
}

ReportFigure exact_part_figure(const DxtErrors& errors, const std::string& command) {
  PlotSeries faces{.name = "order of faces", .points = {}}, ordered{.name = "rows and columns", .points = {}},
      filled{.name = "improved", .points = {}};
  for (const ExactPartRow& row : errors.exact_parts) {
    faces.points.push_back({100 * row.exact, row.without_order, 0, ""});
    ordered.points.push_back({100 * row.exact, row.ordered, 0, ""});
    filled.points.push_back({100 * row.exact, row.filled, 0, ""});
  }
  Plot plot;
  plot.title = "Total error and the exact part";
  plot.panels.push_back({.title = "",
                         .x = {.label = "exact part, %"},
                         .y = {.label = "total error", .scale = Scale::logarithmic},
                         .series = {faces, ordered, filled}});
  return {
      "Figure 2. Improved: codes over what the numbers span, texels of exact entries free, order along "
      "curves on the faces, blocks by cluster fit.",
      command, to_svg(plot)};
}

std::string answer_cell(const std::optional<AnswerErrors>& errors, double AnswerErrors::*which) {
  return errors ? fmt::format("{:.2e}", (*errors).*which) : "none";
}

ReportTable bounces_table(const DxtErrors& errors, const std::string& command) {
  ReportTable table{.caption =
                        "Mean error after k bounces, against as many of T (infinite: against B): the "
                        "sum S_k in one compressed matrix, and the compressed one-bounce matrix "
                        "iterated (infinite: solved).",
                    .command = command,
                    .columns = {"variant", "bounces", "sum: B", "indirect", "iterated: B", "indirect"},
                    .rows = {},
                    .text_columns = 1};
  for (const BouncesRow& row : errors.bounces)
    table.rows.push_back({row.variant, row.bounces ? bounce_text(row.bounces) : "∞",
                          answer_cell(row.summed, &AnswerErrors::radiosity),
                          answer_cell(row.summed, &AnswerErrors::indirect),
                          answer_cell(row.iterated, &AnswerErrors::radiosity),
                          answer_cell(row.iterated, &AnswerErrors::indirect)});
  return table;
}

ReportTable improvement_table(const DxtErrors& errors, const DxtErrorsOptions& options,
                              const std::string& command) {
  ReportTable table{.caption = fmt::format(
                        "What improves the compressed matrix, step by step: relative error of T, mean "
                        "errors of B and of indirect light over {} lights, with the scene's reflectances "
                        "and with {} everywhere. None: no solver finds a solution.",
                        options.lights.total(), options.high_reflectance),
                    .command = command,
                    .columns = {"step", "operator", "bytes a patch", "error in T", "in B", "indirect",
                                fmt::format("in B at {}", options.high_reflectance), "indirect"},
                    .rows = {},
                    .text_columns = 2};
  for (const ImprovementStep& step : errors.steps)
    table.rows.push_back(
        {step.change, step.answer.spec,
         fmt::format("{:.0f}", static_cast<double>(step.answer.bytes) / static_cast<double>(errors.patches)),
         step.answer.operator_error ? fmt::format("{:.2e}", *step.answer.operator_error) : "–",
         answer_cell(step.answer.errors, &AnswerErrors::radiosity),
         answer_cell(step.answer.errors, &AnswerErrors::indirect),
         answer_cell(step.at_high.errors, &AnswerErrors::radiosity),
         answer_cell(step.at_high.errors, &AnswerErrors::indirect)});
  return table;
}

}  // namespace

ReportSection dxt_errors_section(const DxtErrors& errors, const DxtErrorsOptions& options,
                                 const std::string& command) {
  ReportSection section{"Form factors as a compressed texture: errors (document 000)", {}};
  section.blocks.emplace_back(ReportText{histogram_finding(errors)});
  section.blocks.emplace_back(factors_figure(errors.histograms, command));
  section.blocks.emplace_back(codes_figure(errors.histograms, command));
  section.blocks.emplace_back(exact_part_table(errors, command));
  section.blocks.emplace_back(exact_part_figure(errors, command));
  section.blocks.emplace_back(ReportText{reordering_finding(errors)});
  section.blocks.emplace_back(reordering_table(errors, command));
  section.blocks.emplace_back(ReportText{published_table_finding(errors)});
  section.blocks.emplace_back(ReportText{bytes_finding(errors)});
  section.blocks.emplace_back(bounces_table(errors, command));
  section.blocks.emplace_back(ReportText{bounces_finding(errors)});
  section.blocks.emplace_back(improvement_table(errors, options, command));
  section.blocks.emplace_back(ReportText{improvement_finding(errors, options)});
  return section;
}

}  // namespace radiosity

#include "experiments/low_rank_radiosity/coherence_pictures.hpp"
#include "experiments/svg_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace radiosity {
namespace {

std::string in_percent(double fraction) {
  return fmt::format("{:.{}f}\u00a0%", 100 * fraction, fraction < 0.1 ? 1 : 0);
}

const std::string& group_of(const PatchMesh& mesh, Index patch) {
  return mesh.scene->groups[static_cast<std::size_t>(mesh.patches[static_cast<std::size_t>(patch)].group)];
}

PlotSeries row_series(const FormFactors& form_factors, Index patch) {
  PlotSeries series{.name = fmt::format("row {}", patch), .points = {}, .markers = false};
  const Index n = form_factors.patch_count();
  series.points.reserve(static_cast<std::size_t>(n));
  for (Index j = 0; j < n; ++j)
    series.points.push_back({static_cast<double>(j), form_factors(patch, j), 0, ""});
  return series;
}

/// Both rows, and what is between them.
ReportFigure rows_figure(const CoherenceMeasurement& measurement, const NeighbourPair& pair,
                         const std::string& command) {
  const FormFactors& F = measurement.form_factors;
  Plot plot;
  plot.title = fmt::format("Rows {} and {} of F", pair.first, pair.second);
  for (const Index patch : {pair.first, pair.second})
    plot.panels.push_back(
        {.title = "", .x = {.label = "patch"}, .y = {.label = "F"}, .series = {row_series(F, patch)}});
  PlotPanel difference{.title = "", .x = {.label = "patch"}, .y = {.label = "|difference|"}, .series = {}};
  PlotSeries series{.name = "difference", .points = {}, .markers = false};
  double highest = 0;
  for (Index j = 0; j < F.patch_count(); ++j) {
    const double a = F(pair.first, j), b = F(pair.second, j);
    highest = std::max({highest, a, b});
    series.points.push_back({static_cast<double>(j), std::abs(a - b), 0, ""});
  }
  difference.series.push_back(series);
  plot.panels.push_back(difference);
  for (PlotPanel& panel : plot.panels) {
    panel.y.low = 0;
    panel.y.high = highest;
  }
  plot.panel_width = 320;
  plot.panel_height = 240;
  return {fmt::format("Their rows of F over the patches, and what is between the two: {} of a row in the "
                      "Euclidean norm, and {} of their light goes elsewhere.",
                      in_percent(pair.row_difference), in_percent(pair.redirected)),
          command, to_svg(plot)};
}

std::string views_caption(const CoherenceMeasurement& measurement, const NeighbourPair& pair,
                          const std::string& which) {
  const PatchMesh& mesh = *measurement.form_factors.mesh;
  return fmt::format(
      "What patches {} and {} on '{}' see ({} patches): {}. The hemisphere is projected on the plane of the "
      "patch, so that areas of the disc are form factors. The views differ by {:.3f} on a scale from 0 to 1.",
      pair.first, pair.second, group_of(mesh, pair.first), mesh.patch_count(), which, pair.view_difference);
}

ReportFigure scatter_figure(const CoherenceMeasurement& measurement, const std::string& command) {
  PlotSeries series{.name = "pairs of neighbours", .points = {}, .line = false};
  std::vector<double> views, rows;
  for (const NeighbourPair& pair : measurement.pairs) {
    views.push_back(pair.view_difference);
    rows.push_back(pair.row_difference);
    series.points.push_back({pair.view_difference, pair.row_difference, 0, ""});
  }
  Plot plot;
  plot.title = "Similar views, similar rows";
  plot.panels.push_back({.title = "",
                         .x = {.label = "difference of the scene views"},
                         .y = {.label = "relative difference of the rows of F"},
                         .series = {series}});
  return {
      fmt::format("All {} pairs of neighbours: rows differ by {} in the median and by {} at most. The rank "
                  "correlation of both differences is {:.2f}.",
                  measurement.pairs.size(), in_percent(measurement.typical_pair().row_difference),
                  in_percent(measurement.extreme_pair().row_difference), rank_correlation(views, rows)),
      command, to_svg(plot)};
}

/// The group whose patches are the most coherent in the mean over its area, and the one least so.
std::pair<std::string, std::string> most_and_least_coherent(const CoherenceMeasurement& measurement) {
  const PatchMesh& mesh = *measurement.fine;
  const auto groups = static_cast<Index>(mesh.scene->groups.size());
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(groups), area = Eigen::ArrayXd::Zero(groups);
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const int group = mesh.patches[static_cast<std::size_t>(i)].group;
    sum[group] += mesh.area[i] * measurement.incoherence[i];
    area[group] += mesh.area[i];
  }
  Index most = -1, least = -1;
  for (Index g = 0; g < groups; ++g) {
    if (area[g] == 0) continue;
    if (most < 0 || sum[g] / area[g] < sum[most] / area[most]) most = g;
    if (least < 0 || sum[g] / area[g] > sum[least] / area[least]) least = g;
  }
  const auto text = [&](Index g) {
    return fmt::format("'{}' ({:.3f})", mesh.scene->groups[static_cast<std::size_t>(g)], sum[g] / area[g]);
  };
  return {text(most), text(least)};
}

std::string coherence_caption(const CoherenceMeasurement& measurement) {
  const auto [most, least] = most_and_least_coherent(measurement);
  const PatchMesh& mesh = *measurement.fine;
  const double mean = mesh.area.dot(measurement.incoherence) / mesh.area.sum();
  return fmt::format(
      "Spatial coherence of {} patches, darker where it is lower: how much scene views differ inside a "
      "patch, "
      "{:.3f} in the mean over the area and {:.3f} at most (black). Most coherent in the mean is {}, least "
      "{}.",
      mesh.patch_count(), mean, measurement.incoherence.maxCoeff(), most, least);
}

/// Mean area of the coarse patches around the fine ones, for the quarter of the patches that is the least
/// coherent over that for the quarter that is the most.
double area_ratio_of_quarters(const CoherenceMeasurement& measurement) {
  std::vector<Index> order(static_cast<std::size_t>(measurement.fine->patch_count()));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return measurement.incoherence[a] < measurement.incoherence[b]; });
  const Eigen::VectorXd area = measurement.area_of_coarse_patch();
  const std::size_t quarter = std::max<std::size_t>(order.size() / 4, 1);
  double most = 0, least = 0;
  for (std::size_t k = 0; k < quarter; ++k) {
    most += area[order[k]];
    least += area[order[order.size() - 1 - k]];
  }
  return least / most;
}

std::string meshes_caption(const CoherenceMeasurement& measurement) {
  const PatchMesh& coarse = measurement.coarse.patches;
  return fmt::format(
      "Left: the {} large patches that 2MSC starts with. Middle: the {} patches that it ends with; the "
      "largest has {:.0f} times the area of the smallest, and around the least coherent quarter of the fine "
      "patches they have {:.2f} times the area of those around the most coherent. Right: the fine mesh of {} "
      "elements.",
      measurement.largest.patch_count(), coarse.patch_count(),
      coarse.area.maxCoeff() / coarse.area.minCoeff(), area_ratio_of_quarters(measurement),
      measurement.fine->patch_count());
}

}  // namespace

ReportSection coherence_section(const CoherenceMeasurement& measurement, const CoherenceFiles& files,
                                const std::string& command) {
  const NeighbourPair& typical = measurement.typical_pair();
  const NeighbourPair& extreme = measurement.extreme_pair();
  ReportSection section{"Scene views, coherence and meshes (document 004, Figures 1 and 2)", {}};
  section.blocks.emplace_back(ReportText{fmt::format(
      "Low rank rests on neighbours that see the same. Half of all neighbours on a face have rows of F that "
      "differ by less than {}; at most it is {}, on '{}'.",
      in_percent(typical.row_difference), in_percent(extreme.row_difference),
      group_of(*measurement.form_factors.mesh, extreme.first))});
  section.blocks.emplace_back(png_figure(
      files.typical_views,
      views_caption(measurement, typical, "half of all neighbours have rows that differ less"), command));
  section.blocks.emplace_back(rows_figure(measurement, typical, command));
  section.blocks.emplace_back(
      png_figure(files.extreme_views,
                 views_caption(measurement, extreme, "the neighbours whose rows differ most"), command));
  section.blocks.emplace_back(rows_figure(measurement, extreme, command));
  section.blocks.emplace_back(scatter_figure(measurement, command));
  section.blocks.emplace_back(png_figure(files.coherence, coherence_caption(measurement), command));
  section.blocks.emplace_back(png_figure(files.meshes, meshes_caption(measurement), command));
  return section;
}

}  // namespace radiosity

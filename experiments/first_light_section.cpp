#include "experiments/comparison_plot.hpp"
#include "experiments/first_light.hpp"

#include <fmt/format.h>

namespace radiosity {
namespace {

std::string percent(double fraction, int digits = 2) {
  return fmt::format("{:.{}f}\u00a0%", 100 * fraction, digits);
}

std::string small(const std::optional<double>& value) {
  return !value ? "–" : *value == 0 ? "0" : fmt::format("{:.1e}", *value);
}

std::string milliseconds(double seconds) {
  return fmt::format("{:.3g}", 1e3 * seconds);
}

ReportTable form_factor_table(const FirstLightMeasurement& measurement) {
  ReportTable table;
  table.caption =
      "Form factors. In this closed room every row of F should sum to 1; the accurate ones are shown before "
      "(raw) and after their closure. One-ray form factors (003) use one ray and one point a pair.";
  table.columns = {"patches", "seconds",         "rays",        "rms of row sum − 1, raw",
                   "closed",  "one-ray seconds", "one-ray rms", "one-ray range"};
  for (const FirstLightSize& size : measurement.sizes) {
    const FormFactorQuality& accurate = size.accurate.quality;
    const FormFactorQuality& one_ray = size.one_ray.quality;
    table.rows.push_back({std::to_string(size.mesh->patch_count()), fmt::format("{:.2f}", accurate.seconds),
                          fmt::format("{:.2g} M", 1e-6 * static_cast<double>(accurate.rays)),
                          small(size.raw_row_sum_rms), small(accurate.row_sum_rms),
                          fmt::format("{:.2f}", one_ray.seconds), small(one_ray.row_sum_rms),
                          fmt::format("{:.2f} … {:.2f}", one_ray.row_sum_min, one_ray.row_sum_max)});
  }
  return table;
}

ReportTable operator_table(const FirstLightMeasurement& measurement) {
  ReportTable table;
  table.caption = fmt::format(
      "Operators on the same form factors, lit by the scene's own light. Errors are relative and weighted by "
      "area, against the double-precision solution; solvers stop at a relative residual of {:.0e}, which is "
      "what exact operators have left. The last line of each size is what one-ray form factors do to that "
      "solution.",
      measurement.tolerance);
  table.columns = {"patches",  "operator",   "MB",   "apply, ms", "solve, ms",
                   "products", "error in T", "in B", "in B − E"};
  table.text_columns = 2;
  for (const FirstLightSize& size : measurement.sizes) {
    const std::string patches = std::to_string(size.mesh->patch_count());
    for (const ComparisonResult& result : size.operators)
      table.rows.push_back({patches, result.spec,
                            fmt::format("{:.3g}", 1e-6 * static_cast<double>(result.bytes)),
                            milliseconds(result.apply.min), milliseconds(result.solve.min),
                            std::to_string(result.iterations), small(result.errors.operator_frobenius),
                            small(result.errors.radiosity_mean), small(result.errors.indirect_mean)});
    table.rows.push_back({patches, "one-ray F", "–", "–", "–", "–", "–", small(size.one_ray.radiosity_error),
                          small(size.one_ray.indirect_error)});
  }
  return table;
}

ReportTable referee_table(const FirstLightMeasurement& measurement) {
  ReportTable table;
  table.caption =
      "The referee: reflected light against a path tracer that shares no transport code with radiosity. "
      "Mean: does "
      "the solution hold the right amount of light? Rms over patches, the referee's noise taken out: is it "
      "in the right places? ± one standard error.";
  table.columns = {"patches",      "paths a patch", "mean difference", "rms",
                   "one-ray mean", "one-ray rms",   "seconds"};
  const auto mean = [](const ReferenceComparison& difference) {
    return fmt::format("{:+.2f} ± {:.2f}\u00a0%", 100 * difference.mean_difference,
                       100 * difference.mean_difference_standard_error);
  };
  const auto rms = [](const ReferenceComparison& difference) {
    return fmt::format("{:.2f} ± {:.2f}\u00a0%", 100 * difference.rms_difference,
                       100 * difference.rms_difference_standard_error);
  };
  for (const FirstLightSize& size : measurement.sizes)
    table.rows.push_back({std::to_string(size.mesh->patch_count()), std::to_string(size.referee.paths),
                          mean(size.accurate.difference), rms(size.accurate.difference),
                          mean(size.one_ray.difference), rms(size.one_ray.difference),
                          fmt::format("{:.1f}", size.referee.seconds)});
  return table;
}

/// Rms difference from the referee over the number of patches, for both kinds of form factors.
PlotPanel referee_panel(const FirstLightMeasurement& measurement) {
  PlotPanel panel;
  panel.title = "Radiosity against path tracing";
  panel.x = {"patches", Scale::logarithmic};
  panel.y = {"relative rms difference of reflected light", Scale::logarithmic, 1e-4};
  PlotSeries accurate{"accurate form factors", {}};
  PlotSeries one_ray{"one-ray", {}};
  for (const FirstLightSize& size : measurement.sizes) {
    const auto n = static_cast<double>(size.mesh->patch_count());
    const ReferenceComparison& fine = size.accurate.difference;
    const ReferenceComparison& coarse = size.one_ray.difference;
    accurate.points.push_back({n, fine.rms_difference, fine.rms_difference_standard_error, ""});
    one_ray.points.push_back({n, coarse.rms_difference, coarse.rms_difference_standard_error, ""});
  }
  panel.series = {accurate, one_ray};
  return panel;
}

PlotPanel apply_panel(const FirstLightMeasurement& measurement) {
  PlotPanel panel;
  panel.title = "Time of one apply, all channels";
  panel.x = {"patches", Scale::logarithmic};
  panel.y = {"ms", Scale::logarithmic};
  for (std::size_t k = 0; k < measurement.sizes.front().operators.size(); ++k) {
    PlotSeries series{measurement.sizes.front().operators[k].spec, {}};
    for (const FirstLightSize& size : measurement.sizes)
      series.points.push_back(
          {static_cast<double>(size.mesh->patch_count()), 1e3 * size.operators[k].apply.min, 0, ""});
    panel.series.push_back(series);
  }
  return panel;
}

std::string summary(const FirstLightMeasurement& measurement) {
  const FirstLightSize& finest = measurement.sizes.back();
  return fmt::format(
      "The closed Cornell box, from {} to {} patches. At {} patches the reflected light of the radiosity "
      "solution "
      "differs from path tracing by {} in the mean and {} (rms) from patch to patch; one-ray form factors "
      "are off by {} and {}.",
      measurement.sizes.front().mesh->patch_count(), finest.mesh->patch_count(), finest.mesh->patch_count(),
      percent(std::abs(finest.accurate.difference.mean_difference)),
      percent(finest.accurate.difference.rms_difference),
      percent(std::abs(finest.one_ray.difference.mean_difference)),
      percent(finest.one_ray.difference.rms_difference));
}

}  // namespace

ReportSection first_light_section(const FirstLightMeasurement& measurement, const std::string& command) {
  Plot growth;
  growth.panels = {referee_panel(measurement), apply_panel(measurement)};
  std::vector<ComparisonPoint> points;
  const FirstLightSize& finest = measurement.sizes.back();
  for (const ComparisonResult& result : finest.operators)
    points.push_back({result.spec, static_cast<double>(result.bytes), result.apply.min,
                      result.errors.radiosity_mean.value_or(0)});
  const std::string cost_title = fmt::format("Operators at {} patches", finest.mesh->patch_count());

  ReportSection section{"First light: the Cornell box", {}};
  section.blocks.emplace_back(ReportText{summary(measurement)});
  std::vector<ReportTable> tables = {form_factor_table(measurement), operator_table(measurement),
                                     referee_table(measurement)};
  for (ReportTable& table : tables) {
    table.command = command;
    section.blocks.emplace_back(std::move(table));
  }
  section.blocks.emplace_back(
      ReportFigure{"Left: what is left between radiosity and path tracing shrinks with the number of "
                   "patches. Right: the time of "
                   "one product with the operator.",
                   command, to_svg(growth)});
  section.blocks.emplace_back(ReportFigure{"Error of each operator against what it costs.", command,
                                           to_svg(comparison_plot(points, cost_title))});
  return section;
}

}  // namespace radiosity

#include "experiments/comparison_plot.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

constexpr double smallest_error = 1e-10;

struct Unit {
  double size;
  const char* name;
};

/// The largest unit that is not above the largest value.
template <std::size_t count>
Unit choose_unit(const Unit (&units)[count], double largest) {
  Unit chosen = units[0];
  for (const Unit& unit : units)
    if (largest >= unit.size) chosen = unit;
  return chosen;
}

PlotAxis error_axis(const std::vector<ComparisonPoint>& points) {
  PlotAxis axis{"relative error in B, mean over the lights", Scale::logarithmic};
  const auto [least, most] = std::minmax_element(
      points.begin(), points.end(),
      [](const ComparisonPoint& a, const ComparisonPoint& b) { return a.error < b.error; });
  if (least->error < smallest_error) axis.low = smallest_error;
  if (most->error < 10 * smallest_error) axis.high = 100 * smallest_error;
  return axis;
}

PlotPanel panel(const std::vector<ComparisonPoint>& points, const std::string& title,
                const std::string& quantity, double ComparisonPoint::*cost, Unit unit) {
  PlotPanel panel;
  panel.title = title;
  panel.x = {fmt::format("{}, {}", quantity, unit.name), Scale::logarithmic};
  panel.y = error_axis(points);
  PlotSeries series{"", {}, false, true};
  for (const ComparisonPoint& point : points)
    series.points.push_back({point.*cost / unit.size, point.error, 0, point.label});
  panel.series = {series};
  return panel;
}

}  // namespace

Plot comparison_plot(const std::vector<ComparisonPoint>& points, const std::string& title) {
  if (points.empty()) fail<UsageError>("the comparison has no operators to plot");
  double largest = 0;
  double slowest = 0;
  for (const ComparisonPoint& point : points) {
    if (!(point.bytes > 0) || !(point.apply_seconds > 0) || !(point.error >= 0) ||
        !std::isfinite(point.error))
      fail<UsageError>("operator '{}' cannot be plotted: {} bytes, {} s an apply, error {}", point.label,
                       point.bytes, point.apply_seconds, point.error);
    largest = std::max(largest, point.bytes);
    slowest = std::max(slowest, point.apply_seconds);
  }
  static constexpr Unit byte_units[] = {{1, "bytes"}, {1e3, "kB"}, {1e6, "MB"}, {1e9, "GB"}};
  static constexpr Unit time_units[] = {{1e-6, "µs"}, {1e-3, "ms"}, {1, "s"}};
  Plot plot;
  plot.title = title;
  plot.panels = {panel(points, "Error against memory", "resident to apply it", &ComparisonPoint::bytes,
                       choose_unit(byte_units, largest)),
                 panel(points, "Error against time", "time of one apply", &ComparisonPoint::apply_seconds,
                       choose_unit(time_units, slowest))};
  return plot;
}

void write_comparison_plot(const std::filesystem::path& file, const std::vector<ComparisonPoint>& points,
                           const std::string& title) {
  write_svg(file, comparison_plot(points, title));
}

}  // namespace radiosity

#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace radiosity {

enum class Scale { linear, logarithmic };

/// What one axis of a plot shows. The range is that of the data, widened to round numbers, unless it is
/// given.
struct PlotAxis {
  std::string label;  ///< with its unit: "time of one apply, ms"
  Scale scale = Scale::linear;
  std::optional<double> low = std::nullopt;  ///< data below is drawn at this edge, and marked as such
  std::optional<double> high = std::nullopt;
};

struct AxisTick {
  double value = 0;
  std::string label;  ///< empty for the small ticks between
};

/// The range of an axis, its ticks, and where a value goes.
class AxisMap {
 public:
  /// Maps the range to pixels begin ... end (which may fall). Throws UsageError for values that are not
  /// finite, for no values and no range, for low >= high, and for a logarithmic range that reaches zero.
  AxisMap(const PlotAxis& axis, std::span<const double> values, double begin, double end);

  double low() const { return low_; }
  double high() const { return high_; }
  const std::vector<AxisTick>& ticks() const { return ticks_; }

  /// Pixel of a value; values outside the range go to its nearer end.
  double position(double value) const;

 private:
  void fit_linear();
  void fit_logarithmic();

  PlotAxis axis_;
  double begin_;
  double end_;
  double low_ = 0;
  double high_ = 1;
  std::vector<AxisTick> ticks_;
};

/// A number as a person would write it on an axis: 0.02, 1500, 3×10⁻⁷.
std::string tick_label(double value);

}  // namespace radiosity

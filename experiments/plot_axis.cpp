#include "experiments/plot_axis.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace radiosity {
namespace {

constexpr std::array<double, 3> round_steps = {1, 2, 5};

/// Between these, numbers are written without a power of ten.
constexpr double smallest_plain = 0.99e-3;
constexpr double largest_plain = 1e5;

/// The largest of 1, 2, 5 x 10^k that is <= value, and the smallest >= value.
double round_below(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value) + 1e-9));
  double best = decade;
  for (const double step : round_steps)
    if (step * decade <= value * (1 + 1e-9)) best = step * decade;
  return best;
}
double round_above(double value) {
  const double below = round_below(value);
  if (below >= value * (1 - 1e-9)) return below;
  return round_below(2.5 * below * (1 + 1e-6));
}

std::string superscript(int exponent) {
  static constexpr std::array<const char*, 10> digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent)))
    text += digits[static_cast<std::size_t>(digit - '0')];
  return text;
}

}  // namespace

std::string tick_label(double value) {
  const double size = std::abs(value);
  if (value == 0) return "0";
  if (size >= smallest_plain && size < largest_plain) {
    std::string text = fmt::format("{:.6g}", value);
    return value < 0 ? "−" + text.substr(1) : text;
  }
  auto exponent = static_cast<int>(std::floor(std::log10(size) + 1e-9));
  const std::string mantissa = fmt::format("{:.4g}", size / std::pow(10.0, exponent));
  const std::string power = "10" + superscript(exponent);
  return (value < 0 ? "−" : "") + (mantissa == "1" ? power : mantissa + "×" + power);
}

AxisMap::AxisMap(const PlotAxis& axis, std::span<const double> values, double begin, double end)
    : axis_(axis), begin_(begin), end_(end) {
  for (const double value : values)
    if (!std::isfinite(value)) fail<UsageError>("the axis '{}' cannot show {}", axis.label, value);
  if (values.empty() && !(axis.low && axis.high))
    fail<UsageError>("the axis '{}' has no data to show", axis.label);
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  low_ = axis.low.value_or(values.empty() ? 0 : *least);
  high_ = axis.high.value_or(values.empty() ? 1 : *most);
  const bool fixed = axis.low && axis.high;
  if (low_ > high_ || (fixed && low_ == high_))
    fail<UsageError>("the axis '{}' cannot run from {} to {}", axis.label, low_, high_);
  if (axis.scale == Scale::logarithmic) {
    if (!(low_ > 0))
      fail<UsageError>("the logarithmic axis '{}' cannot show {}; give it a lower end above zero", axis.label,
                       low_);
    fit_logarithmic();
  } else {
    fit_linear();
  }
}

void AxisMap::fit_linear() {
  if (low_ == high_) {  // one value only: some room around it
    const double room = low_ == 0 ? 1 : 0.1 * std::abs(low_);
    if (!axis_.low) low_ -= room;
    if (!axis_.high) high_ += room;
  }
  constexpr double wanted_intervals = 5;
  const double step = round_above((high_ - low_) / wanted_intervals);
  const double first = std::floor(low_ / step + 1e-9);
  const double last = std::ceil(high_ / step - 1e-9);
  if (!axis_.low) low_ = first * step;
  if (!axis_.high) high_ = last * step;
  const auto count = static_cast<int>(last - first);
  for (int k = 0; k <= count; ++k) {
    const double value = (first + k) * step;
    if (value >= low_ - 1e-9 * step && value <= high_ + 1e-9 * step)
      ticks_.push_back({value, tick_label(value)});
  }
}

void AxisMap::fit_logarithmic() {
  // A little room, so that no point sits on the frame, then out to a round number.
  constexpr double room = 1.15;
  if (!axis_.low) low_ = round_below(low_ / room);
  if (!axis_.high) high_ = round_above(high_ * room);
  const double decades = std::log10(high_ / low_);
  const int every = static_cast<int>(std::ceil(decades / 6 - 1e-9));
  const bool beyond_plain =
      low_ < smallest_plain || high_ >= largest_plain;  // then all decades are powers of ten
  const bool label_steps = decades <= 2.05;
  const auto first = static_cast<int>(std::floor(std::log10(low_) + 1e-9));
  const auto last = static_cast<int>(std::ceil(std::log10(high_) - 1e-9));
  for (int exponent = first; exponent <= last; ++exponent)
    for (int digit = 1; digit <= 9; ++digit) {
      const double value = digit * std::pow(10.0, exponent);
      if (value < low_ * (1 - 1e-9) || value > high_ * (1 + 1e-9)) continue;
      const bool round = digit == 1 || digit == 2 || digit == 5;
      const bool labelled = label_steps ? round : digit == 1 && exponent % every == 0;
      if (!labelled && every > 1 && digit != 1) continue;  // small ticks would merge
      const bool as_power = beyond_plain && digit == 1 && exponent != 0;
      ticks_.push_back({value, !labelled ? "" : as_power ? "10" + superscript(exponent) : tick_label(value)});
    }
}

double AxisMap::position(double value) const {
  const double inside = std::clamp(value, low_, high_);
  const double fraction = axis_.scale == Scale::logarithmic ? std::log(inside / low_) / std::log(high_ / low_)
                                                            : (inside - low_) / (high_ - low_);
  return begin_ + fraction * (end_ - begin_);
}

}  // namespace radiosity

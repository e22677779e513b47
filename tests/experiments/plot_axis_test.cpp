#include "experiments/plot_axis.hpp"
#include "foundation/error.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

namespace radiosity {
namespace {

std::string labels(const AxisMap& map) {
  std::string text;
  for (const AxisTick& tick : map.ticks())
    if (!tick.label.empty()) text += tick.label + " ";
  return text;
}

TEST(PlotAxis, LinearTicksAreRoundNumbers) {
  const std::vector<double> values = {3, 97};
  const AxisMap map({"x"}, values, 0, 500);
  EXPECT_EQ(labels(map), "0 20 40 60 80 100 ");
  EXPECT_EQ(map.low(), 0);
  EXPECT_EQ(map.high(), 100);
  EXPECT_DOUBLE_EQ(map.position(50), 250);
  EXPECT_DOUBLE_EQ(map.position(0), 0);
  EXPECT_DOUBLE_EQ(map.position(100), 500);
}

TEST(PlotAxis, LinearAxesCrossZero) {
  const std::vector<double> values = {-0.011, 0.02};
  EXPECT_EQ(labels(AxisMap({"x"}, values, 0, 1)), "−0.02 −0.01 0 0.01 0.02 ");
}

TEST(PlotAxis, LogarithmicTicksAreDecades) {
  const std::vector<double> values = {2e-4, 0.3};
  const AxisMap map({"x", Scale::logarithmic}, values, 400, 0);
  EXPECT_EQ(labels(map), "10⁻⁴ 10⁻³ 10⁻² 10⁻¹ ");
  EXPECT_DOUBLE_EQ(map.low(), 1e-4);
  EXPECT_DOUBLE_EQ(map.high(), 0.5);
  // Halfway between two decades in pixels is the geometric mean.
  EXPECT_NEAR(map.position(std::sqrt(1e-3 * 1e-2)), 0.5 * (map.position(1e-3) + map.position(1e-2)), 1e-9);
  EXPECT_GT(map.position(1e-3), map.position(1e-2));  // pixels fall
}

TEST(PlotAxis, ShortLogarithmicRangesShowSteps) {
  const std::vector<double> values = {300, 3300};
  EXPECT_EQ(labels(AxisMap({"n", Scale::logarithmic}, values, 0, 1)), "200 500 1000 2000 5000 ");
}

TEST(PlotAxis, LongLogarithmicRangesSkipDecades) {
  const std::vector<double> values = {1e-15, 1};
  const AxisMap map({"x", Scale::logarithmic}, values, 0, 1);
  int labelled = 0;
  for (const AxisTick& tick : map.ticks()) labelled += tick.label.empty() ? 0 : 1;
  EXPECT_GE(labelled, 4);
  EXPECT_LE(labelled, 8);
}

TEST(PlotAxis, OneValueHasRoomAroundIt) {
  const std::vector<double> one = {5};
  for (const Scale scale : {Scale::linear, Scale::logarithmic}) {
    const AxisMap map({"x", scale}, one, 0, 100);
    EXPECT_LT(map.low(), 5);
    EXPECT_GT(map.high(), 5);
    EXPECT_GE(map.ticks().size(), 2U);
  }
}

TEST(PlotAxis, FixedRangesAreKept) {
  const std::vector<double> values = {0, 1e-20, 0.5};
  const AxisMap map({"x", Scale::logarithmic, 1e-10}, values, 0, 100);
  EXPECT_EQ(map.low(), 1e-10);
  EXPECT_EQ(map.position(0), 0);  // below: at the edge
}

TEST(PlotAxis, RefusesWhatItCannotShow) {
  const auto refuses = [](const PlotAxis& axis, const std::vector<double>& values) {
    EXPECT_THROW(AxisMap(axis, values, 0, 1), UsageError) << axis.label;
  };
  refuses({"nothing"}, {});
  refuses({"not a number"}, {1, std::numeric_limits<double>::quiet_NaN()});
  refuses({"infinity"}, {std::numeric_limits<double>::infinity()});
  refuses({"zero on a logarithmic axis", Scale::logarithmic}, {0, 1});
  refuses({"backwards", Scale::linear, 2, 1}, {1});
}

TEST(PlotAxis, NumbersAreWrittenAsAPersonWould) {
  EXPECT_EQ(tick_label(0), "0");
  EXPECT_EQ(tick_label(0.02), "0.02");
  EXPECT_EQ(tick_label(1500), "1500");
  EXPECT_EQ(tick_label(-3), "−3");
  EXPECT_EQ(tick_label(3e-7), "3×10⁻⁷");
  EXPECT_EQ(tick_label(1e-10), "10⁻¹⁰");
  EXPECT_EQ(tick_label(2.5e6), "2.5×10⁶");
}

}  // namespace
}  // namespace radiosity

#include "experiments/comparison_plot.hpp"
#include "experiments/label_placement.hpp"
#include "experiments/svg_plot.hpp"
#include "foundation/error.hpp"
#include "tests/temporary_folder.hpp"
#include "well_formed.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>

namespace radiosity {
namespace {

using test::xml_problem;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

Plot simple_plot() {
  Plot plot;
  plot.title = "Less <than> & \"more\"";
  PlotPanel panel;
  panel.title = "A panel";
  panel.x = {"patches", Scale::linear, 0, 10};
  panel.y = {"error", Scale::linear, 0, 1};
  panel.series = {{"one", {{2, 0.25, 0, ""}, {4, 0.5, 0, ""}, {10, 1, 0, ""}}}};
  plot.panels = {panel};
  return plot;
}

struct Circle {
  double x;
  double y;
};

std::vector<Circle> circles(const std::string& svg) {
  std::vector<Circle> found;
  const std::regex pattern(R"re(<circle cx="([\d.]+)" cy="([\d.]+)")re");
  for (std::sregex_iterator at(svg.begin(), svg.end(), pattern), end; at != end; ++at)
    found.push_back({std::stod((*at)[1]), std::stod((*at)[2])});
  return found;
}

TEST(SvgPlot, IsWellFormedAndDeterministic) {
  const std::string svg = to_svg(simple_plot());
  EXPECT_EQ(xml_problem(svg), "");
  EXPECT_EQ(svg, to_svg(simple_plot()));
  EXPECT_NE(svg.find("Less &lt;than&gt; &amp; &quot;more&quot;"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  // The check itself must be able to fail.
  EXPECT_NE(xml_problem("<svg><text>a & b</text></svg>"), "");
  EXPECT_NE(xml_problem("<svg><g></svg></g>"), "");
}

TEST(SvgPlot, ValuesGoToTheirPixels) {
  const std::vector<Circle> points = circles(to_svg(simple_plot()));
  ASSERT_EQ(points.size(), 3U);
  // Equal steps of value are equal steps of pixels: (2, .25), (4, .5), (10, 1).
  EXPECT_NEAR((points[2].x - points[0].x) / (points[1].x - points[0].x), 4, 0.01);
  EXPECT_NEAR((points[2].y - points[0].y) / (points[1].y - points[0].y), 3, 0.01);
  EXPECT_LT(points[1].y, points[0].y);  // upwards
  // The last one lies in the corner of the frame: the right end of the horizontal axis, the upper of the
  // vertical one.
  const std::string svg = to_svg(simple_plot());
  const std::regex axis_line(R"re(x2="([\d.]+)" y2="([\d.]+)" class="plot-axis")re");
  std::vector<Circle> ends;
  for (std::sregex_iterator at(svg.begin(), svg.end(), axis_line), end; at != end; ++at)
    ends.push_back({std::stod((*at)[1]), std::stod((*at)[2])});
  ASSERT_GE(ends.size(), 2U);  // the axes come last, after their ticks
  EXPECT_NEAR(points[2].x, ends[ends.size() - 2].x, 0.01);
  EXPECT_NEAR(points[0].x, ends.back().x + 0.2 * (ends[ends.size() - 2].x - ends.back().x), 0.01);
}

TEST(SvgPlot, SeriesDifferInColourAndMarker) {
  Plot plot = simple_plot();
  plot.panels[0].series.push_back({"two", {{1, 0.1, 0.05, ""}, {9, 0.9, 0, ""}}});
  const std::string svg = to_svg(plot);
  EXPECT_EQ(xml_problem(svg), "");
  EXPECT_EQ(count(svg, "class=\"plot-marker plot-0\""), 4U);  // three points and the legend
  EXPECT_EQ(count(svg, "class=\"plot-marker plot-1\""), 3U);
  EXPECT_EQ(count(svg, "<polyline"), 2U);
  EXPECT_EQ(count(svg, "class=\"plot-bar plot-1\""), 3U);  // one bar and its two ends
  EXPECT_NE(svg.find(">two</text>"), std::string::npos);
}

TEST(SvgPlot, ValuesBeyondTheAxisAreMarked) {
  Plot plot = simple_plot();
  plot.panels[0].y = {"error", Scale::logarithmic, 1e-3};
  plot.panels[0].series[0].points[0].y = 0;
  const std::string svg = to_svg(plot);
  EXPECT_EQ(count(svg, "class=\"plot-outside plot-0\""), 1U);
  EXPECT_NE(svg.find("below the axis"), std::string::npos);
  EXPECT_EQ(to_svg(simple_plot()).find("below the axis"), std::string::npos);
}

TEST(SvgPlot, RefusesEmptyData) {
  EXPECT_THROW(to_svg(Plot{}), UsageError);
  Plot plot = simple_plot();
  plot.panels[0].series[0].points.clear();
  EXPECT_THROW(to_svg(plot), UsageError);
  plot = simple_plot();
  plot.panels[0].series[0].points[0].x = 11;  // beyond the end given for the horizontal axis
  EXPECT_THROW(to_svg(plot), UsageError);
}

TEST(LabelPlacement, LabelsDoNotOverlapWhereThereIsRoom) {
  LabelPlacement labels({0, 0, 400, 300});
  const std::vector<std::array<double, 2>> points = {{100, 100}, {105, 103}, {110, 98}, {390, 10}, {5, 295}};
  for (const auto& [x, y] : points) labels.block({x - 4, y - 4, x + 4, y + 4});
  std::vector<Box> boxes;
  boxes.reserve(points.size());
  for (const auto& [x, y] : points) boxes.push_back(labels.place(x, y, 4, 60, 14));
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    EXPECT_GE(boxes[i].left, 0);
    EXPECT_LE(boxes[i].right, 400);
    EXPECT_GE(boxes[i].top, 0);
    EXPECT_LE(boxes[i].bottom, 300);
    for (std::size_t j = 0; j < i; ++j) EXPECT_EQ(overlap(boxes[i], boxes[j]), 0) << i << " " << j;
  }
}

std::vector<ComparisonPoint> three_operators() {
  return {{"dense", 22e6, 4e-3, 0}, {"dense:f16", 5.8e6, 0.7e-3, 2.2e-4}, {"svd:k=216", 2.6e6, 0.4e-3, 2e-3}};
}

TEST(ComparisonPlot, HasTwoPanelsAndEveryOperatorInBoth) {
  const std::string svg = to_svg(comparison_plot(three_operators(), "cornell-box"));
  EXPECT_EQ(xml_problem(svg), "");
  for (const ComparisonPoint& point : three_operators())
    EXPECT_EQ(count(svg, ">" + point.label + "</text>"), 2U);
  EXPECT_NE(svg.find("MB</text>"), std::string::npos);
  EXPECT_NE(svg.find("ms</text>"), std::string::npos);
  EXPECT_EQ(count(svg, "plot-outside plot-0"), 2U);  // dense has no error
}

TEST(ComparisonPlot, ShowsASingleExactOperator) {
  EXPECT_EQ(xml_problem(to_svg(comparison_plot({{"dense", 100, 1e-7, 0}}, "tiny"))), "");
}

TEST(ComparisonPlot, RefusesWhatItCannotShow) {
  EXPECT_THROW(comparison_plot({}, "empty"), UsageError);
  for (const ComparisonPoint& point : {ComparisonPoint{"no bytes", 0, 1, 1},
                                       {"no time", 1, 0, 1},
                                       {"negative error", 1, 1, -1},
                                       {"no number", 1, 1, std::nan("")}})
    EXPECT_THROW(comparison_plot({point}, "wrong"), UsageError) << point.label;
}

TEST(ComparisonPlot, AppearsWholeOrNotAtAll) {
  const TemporaryFolder temporary;
  const auto folder = temporary.path() / "plots";
  EXPECT_THROW(write_comparison_plot(folder / "plot.svg", three_operators(), "no folder"), Error);
  std::filesystem::create_directories(folder);
  EXPECT_THROW(write_comparison_plot(folder / "plot.svg", {}, "nothing"), UsageError);
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  write_comparison_plot(folder / "plot.svg", three_operators(), "cornell-box");
  std::ifstream stream(folder / "plot.svg");
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  EXPECT_EQ(xml_problem(text), "");
}

}  // namespace
}  // namespace radiosity

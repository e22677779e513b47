#pragma once

#include "experiments/plot_axis.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace radiosity {

struct PlotPoint {
  double x = 0;
  double y = 0;
  double error = 0;   ///< half length of a vertical error bar; 0: none
  std::string label;  ///< written beside the point; empty: none
};

/// Points of one colour and marker, in the order in which a line would join them.
struct PlotSeries {
  std::string name;  ///< for the legend
  std::vector<PlotPoint> points;
  bool line = true;
  bool markers = true;
};

struct PlotPanel {
  std::string title;
  PlotAxis x;
  PlotAxis y;
  std::vector<PlotSeries> series;
};

/// Panels side by side under one title.
struct Plot {
  std::string title;
  std::vector<PlotPanel> panels;
  double panel_width = 440;  ///< pixels, with axes and labels
  double panel_height = 340;
};

/// The plot as one SVG element, for a file of its own or inside HTML. Colours can be told apart by the
/// colour-blind (Okabe and Ito 2008) and each series has a marker of its own; follows the reader's choice of
/// a light or dark page. Values below or above a fixed range are drawn at its edge as open triangles, and a
/// note says so. The same plot gives the same text. Throws UsageError for a plot without data and for values
/// that an axis cannot show.
std::string to_svg(const Plot& plot);

/// Writes to_svg as a file that appears whole or not at all.
void write_svg(const std::filesystem::path& file, const Plot& plot);

}  // namespace radiosity

#pragma once

#include "experiments/svg_plot.hpp"

#include <string>

namespace radiosity {

/// One panel of a plot, laid out into the given rectangle and drawn as SVG elements.
/// Throws UsageError for a panel without data and for values that an axis cannot show.
std::string draw_panel(const PlotPanel& panel, double left, double top, double width, double height);

}  // namespace radiosity

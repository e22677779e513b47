#pragma once

#include <cstddef>
#include <string>

namespace radiosity {

/// Single elements of a plot's SVG, positions in pixels, y downwards. Their classes are those of
/// plot_style().

std::string svg_text(double x, double y, const std::string& content, const std::string& attributes);
std::string svg_line(double x1, double y1, double x2, double y2, const std::string& classes);

/// The class of a series' colour; colours repeat after seven.
std::string series_class(std::size_t series);

constexpr double marker_radius = 4;

/// Circle, square, triangle and diamond in turn, so that series differ without their colours too.
std::string series_marker(std::size_t series, double x, double y);

/// An open triangle at the edge of the plot that a value lies beyond: below if `below`, else above.
std::string outside_marker(std::size_t series, double x, double y, bool below);

/// The <style> element. Class names carry a prefix, since inside HTML a style holds for the whole page.
const std::string& plot_style();

}  // namespace radiosity

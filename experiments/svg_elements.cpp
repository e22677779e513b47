#include "experiments/svg_elements.hpp"

#include "experiments/markup.hpp"

#include <fmt/format.h>

#include <array>
#include <span>

namespace radiosity {
namespace {

constexpr std::size_t series_colors = 7;

std::string polygon(std::span<const std::array<double, 2>> corners, double x, double y,
                    const std::string& classes) {
  std::string points;
  for (const auto& [dx, dy] : corners) points += fmt::format("{:.2f},{:.2f} ", x + dx, y + dy);
  points.pop_back();
  return fmt::format("<polygon points=\"{}\" class=\"{}\"/>\n", points, classes);
}

}  // namespace

std::string svg_text(double x, double y, const std::string& content, const std::string& attributes) {
  return fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" {}>{}</text>\n", x, y, attributes,
                     escape_markup(content));
}

std::string svg_line(double x1, double y1, double x2, double y2, const std::string& classes) {
  return fmt::format("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" class=\"{}\"/>\n", x1, y1,
                     x2, y2, classes);
}

std::string series_marker(std::size_t series, double x, double y) {
  const std::string classes = "plot-marker " + series_class(series);
  constexpr double r = marker_radius;
  constexpr std::array<std::array<double, 2>, 4> square = {{{-r, -r}, {r, -r}, {r, r}, {-r, r}}};
  constexpr std::array<std::array<double, 2>, 3> triangle = {{{-r, r}, {0, -r}, {r, r}}};
  constexpr std::array<std::array<double, 2>, 4> diamond = {
      {{0, -1.3 * r}, {1.3 * r, 0}, {0, 1.3 * r}, {-1.3 * r, 0}}};
  switch (series % 4) {
    case 1:
      return polygon(square, x, y, classes);
    case 2:
      return polygon(triangle, x, y, classes);
    case 3:
      return polygon(diamond, x, y, classes);
    default:
      return fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" class=\"{}\"/>\n", x, y, r,
                         classes);
  }
}

std::string outside_marker(std::size_t series, double x, double y, bool below) {
  constexpr double r = marker_radius + 1;
  const double tip = below ? r : -r;
  const std::array<std::array<double, 2>, 3> corners = {{{-r, -tip}, {r, -tip}, {0, 0.6 * tip}}};
  return polygon(corners, x, y, "plot-outside " + series_class(series));
}

std::string series_class(std::size_t series) {
  return fmt::format("plot-{}", series % series_colors);
}

const std::string& plot_style() {
  static const std::string style = R"(<style>
.plot{font-family:system-ui,-apple-system,"Segoe UI",Roboto,Helvetica,Arial,sans-serif;font-size:12px}
.plot-paper{fill:#ffffff}.plot-ink{fill:#24292f}.plot-muted{fill:#57606a}
.plot-axis{stroke:#8c959f;fill:none}.plot-grid{stroke:#e4e7eb}
.plot-0{stroke:#0072b2;fill:#0072b2}.plot-1{stroke:#d55e00;fill:#d55e00}
.plot-2{stroke:#009e73;fill:#009e73}.plot-3{stroke:#b9609a;fill:#b9609a}
.plot-4{stroke:#c98a00;fill:#c98a00}.plot-5{stroke:#3a9fd8;fill:#3a9fd8}.plot-6{stroke:#6e7781;fill:#6e7781}
.plot-line{fill:none;stroke-width:2;stroke-linejoin:round}.plot-bar{fill:none;stroke-width:1.2}
.plot-marker{stroke-width:1.5}.plot-outside{fill-opacity:0;stroke-width:1.8}
@media(prefers-color-scheme:dark){
.plot-paper{fill:#15181c}.plot-ink{fill:#e6e9ec}.plot-muted{fill:#a0a8b1}
.plot-axis{stroke:#6e7781}.plot-grid{stroke:#2b3036}.plot-0{stroke:#4aa8e0;fill:#4aa8e0}
.plot-1{stroke:#f08a3c;fill:#f08a3c}.plot-2{stroke:#34c79b;fill:#34c79b}.plot-3{stroke:#dd96c4;fill:#dd96c4}}
</style>
)";
  return style;
}

}  // namespace radiosity

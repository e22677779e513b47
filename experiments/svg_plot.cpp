#include "experiments/svg_plot.hpp"

#include "experiments/markup.hpp"
#include "experiments/panel_drawing.hpp"
#include "experiments/svg_elements.hpp"
#include "foundation/error.hpp"
#include "foundation/output_file.hpp"

namespace radiosity {
namespace {

constexpr double figure_margin = 14;

}  // namespace

std::string to_svg(const Plot& plot) {
  if (plot.panels.empty()) fail<UsageError>("the plot '{}' has no panels to show", plot.title);
  const double head = plot.title.empty() ? 8 : 36;
  const double width =
      figure_margin + static_cast<double>(plot.panels.size()) * (plot.panel_width + figure_margin);
  const double height = head + plot.panel_height + 8;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" role=\"img\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "width=\"{0:.0f}\" height=\"{1:.0f}\">\n<title>{2}</title>\n",
      width, height, escape_markup(plot.title.empty() ? plot.panels[0].title : plot.title));
  svg += plot_style();
  svg += fmt::format("<rect width=\"{:.0f}\" height=\"{:.0f}\" class=\"plot-paper\"/>\n", width, height);
  if (!plot.title.empty())
    svg += svg_text(figure_margin, 23, plot.title, "class=\"plot-ink\" font-weight=\"600\" font-size=\"15\"");
  double left = figure_margin;
  for (const PlotPanel& panel : plot.panels) {
    svg += draw_panel(panel, left, head, plot.panel_width, plot.panel_height);
    left += plot.panel_width + figure_margin;
  }
  return svg + "</svg>\n";
}

void write_svg(const std::filesystem::path& file, const Plot& plot) {
  const std::string svg = to_svg(plot);
  OutputFile output(file);
  output.stream() << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" << svg;
  output.commit();
}

}  // namespace radiosity

#include "experiments/panel_drawing.hpp"

#include "experiments/label_placement.hpp"
#include "experiments/svg_elements.hpp"
#include "foundation/error.hpp"

#include <algorithm>
#include <array>

namespace radiosity {
namespace {

constexpr double text_size = 12;
constexpr double line_height = 18;
constexpr double margin = 14;

/// Lays one panel out and draws it.
class PanelDrawing {
 public:
  PanelDrawing(const PlotPanel& panel, double left, double top, double width, double height)
      : panel_(panel), left_(left), width_(width) {
    for (const PlotSeries& series : panel.series)
      for (const PlotPoint& point : series.points) {
        if (point.x < panel.x.low.value_or(point.x) || point.x > panel.x.high.value_or(point.x))
          fail<UsageError>("the plot '{}' has data at {}, beyond the ends given for '{}'", panel.title,
                           point.x, panel.x.label);
        xs_.push_back(point.x);
        // A fixed end stands for all that lies beyond it.
        ys_.push_back(std::max(point.y, panel.y.low.value_or(point.y)));
        if (point.error > 0) {
          ys_.push_back(point.y + point.error);
          if (panel.y.scale == Scale::linear || point.y > point.error) ys_.push_back(point.y - point.error);
        }
      }
    if (xs_.empty()) fail<UsageError>("the plot '{}' has no data to show", panel.title);
    lay_out_legend();
    const double head =
        (panel.title.empty() ? 0 : line_height) + legend_rows_ * line_height + line_height + 8;
    frame_ = {left, top + head, left + width - margin, top + height - 3 * line_height};
    const AxisMap widths(panel.y, ys_, 0, 1);
    double widest = 0;
    for (const AxisTick& tick : widths.ticks()) widest = std::max(widest, text_width(tick.label, text_size));
    frame_.left += widest + 10;
    title_baseline_ = top + 13;
  }

  std::string draw() {
    const AxisMap x(panel_.x, xs_, frame_.left, frame_.right);
    const AxisMap y(panel_.y, ys_, frame_.bottom, frame_.top);
    std::string svg = draw_titles() + draw_axes(x, y);
    LabelPlacement labels(frame_);
    for (const PlotSeries& series : panel_.series)
      for (const PlotPoint& point : series.points) {
        const double px = x.position(point.x);
        const double py = y.position(point.y);
        labels.block({px - marker_radius, py - marker_radius, px + marker_radius, py + marker_radius});
      }
    for (std::size_t s = 0; s < panel_.series.size(); ++s) svg += draw_series(s, x, y, labels);
    if (!beyond_note_.empty())
      svg += svg_text(frame_.right, frame_.bottom + 2.75 * line_height, beyond_note_,
                      "class=\"plot-muted\" text-anchor=\"end\"");
    return svg;
  }

 private:
  bool has_legend() const { return panel_.series.size() > 1; }

  void lay_out_legend() {
    if (!has_legend()) return;
    legend_rows_ = 1;
    double x = 0;
    for (const PlotSeries& series : panel_.series) {
      const double needed = text_width(series.name, text_size) + 38;
      if (x > 0 && x + needed > width_ - margin) {
        x = 0;
        legend_rows_ += 1;
      }
      legend_.push_back({x, (legend_rows_ - 1) * line_height});
      x += needed;
    }
  }

  std::string draw_titles() const {
    std::string svg;
    double baseline = title_baseline_;
    if (!panel_.title.empty()) {
      svg +=
          svg_text(left_, baseline, panel_.title, "class=\"plot-ink\" font-weight=\"600\" font-size=\"13\"");
      baseline += line_height;
    }
    for (std::size_t s = 0; s < legend_.size(); ++s) {
      const double x = left_ + legend_[s][0];
      const double y = baseline + legend_[s][1];
      if (panel_.series[s].line) svg += svg_line(x, y - 4, x + 18, y - 4, "plot-line " + series_class(s));
      if (panel_.series[s].markers) svg += series_marker(s, x + 9, y - 4);
      svg += svg_text(x + 23, y, panel_.series[s].name, "class=\"plot-ink\"");
    }
    svg += svg_text(left_, frame_.top - 13, panel_.y.label, "class=\"plot-muted\"");
    svg += svg_text(0.5 * (frame_.left + frame_.right), frame_.bottom + 2 * line_height, panel_.x.label,
                    "class=\"plot-muted\" text-anchor=\"middle\"");
    return svg;
  }

  std::string draw_axes(const AxisMap& x, const AxisMap& y) const {
    std::string svg;
    for (const AxisTick& tick : y.ticks()) {
      const double at = y.position(tick.value);
      if (tick.label.empty()) {
        svg += svg_line(frame_.left - 3, at, frame_.left, at, "plot-axis");
        continue;
      }
      svg += svg_line(frame_.left, at, frame_.right, at, "plot-grid");
      svg += svg_text(frame_.left - 7, at + 4, tick.label, "class=\"plot-muted\" text-anchor=\"end\"");
    }
    double free_from = frame_.left - margin;  // labels that would touch the one before are left out
    for (const AxisTick& tick : x.ticks()) {
      const double at = x.position(tick.value);
      const double half = 0.5 * text_width(tick.label, text_size);
      const bool labelled = !tick.label.empty() && at - half > free_from;
      svg += svg_line(at, frame_.bottom, at, frame_.bottom + (labelled ? 5 : 3), "plot-axis");
      if (!labelled) continue;
      svg += svg_line(at, frame_.top, at, frame_.bottom, "plot-grid");
      svg += svg_text(at, frame_.bottom + line_height, tick.label,
                      "class=\"plot-muted\" text-anchor=\"middle\"");
      free_from = at + half + 8;
    }
    svg += svg_line(frame_.left, frame_.bottom, frame_.right, frame_.bottom, "plot-axis");
    svg += svg_line(frame_.left, frame_.top, frame_.left, frame_.bottom, "plot-axis");
    return svg;
  }

  std::string draw_series(std::size_t s, const AxisMap& x, const AxisMap& y, LabelPlacement& labels) {
    const PlotSeries& series = panel_.series[s];
    const std::string color = series_class(s);
    std::string line;
    std::string marks;
    for (const PlotPoint& point : series.points) {
      const double px = x.position(point.x);
      const double py = y.position(point.y);
      line += fmt::format("{}{:.2f},{:.2f}", line.empty() ? "" : " ", px, py);
      if (point.error > 0) {
        const double low = panel_.y.scale == Scale::logarithmic && point.y <= point.error
                               ? frame_.bottom
                               : y.position(point.y - point.error);
        const double high = y.position(point.y + point.error);
        marks += svg_line(px, low, px, high, "plot-bar " + color);
        for (const double end : {low, high}) marks += svg_line(px - 3, end, px + 3, end, "plot-bar " + color);
      }
      if (point.y < y.low() || point.y > y.high()) {
        beyond_note_ = point.y < y.low() ? "▽ below the axis" : "△ above the axis";
        marks += outside_marker(s, px, py, point.y < y.low());
      } else if (series.markers) {
        marks += series_marker(s, px, py);
      }
      if (!point.label.empty()) {
        const double label_width = text_width(point.label, text_size);
        const Box box = labels.place(px, py, marker_radius, label_width, text_size + 2);
        marks += svg_text(box.left, box.bottom - 3.5, point.label, "class=\"plot-ink\"");
      }
    }
    if (!series.line || series.points.size() < 2) return marks;
    return fmt::format("<polyline points=\"{}\" class=\"plot-line {}\"/>\n", line, color) + marks;
  }

  const PlotPanel& panel_;
  double left_;
  double width_;
  double title_baseline_ = 0;
  Box frame_;
  std::vector<double> xs_;
  std::vector<double> ys_;
  std::vector<std::array<double, 2>> legend_;
  int legend_rows_ = 0;
  std::string beyond_note_;
};

}  // namespace

std::string draw_panel(const PlotPanel& panel, double left, double top, double width, double height) {
  return PanelDrawing(panel, left, top, width, height).draw();
}

}  // namespace radiosity

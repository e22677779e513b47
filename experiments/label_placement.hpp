#pragma once

#include <string_view>
#include <vector>

namespace radiosity {

/// An axis-aligned box in pixels, y downwards.
struct Box {
  double left = 0;
  double top = 0;
  double right = 0;
  double bottom = 0;
};

/// Area shared by two boxes.
double overlap(const Box& a, const Box& b);

/// Estimated width in pixels of UTF-8 text in a common sans-serif font of `size` pixels.
double text_width(std::string_view text, double size);

/// Finds room for labels beside their points: each goes to the first of sixteen places around its point that
/// touches neither a marker, an earlier label nor the frame, or to the least bad one.
class LabelPlacement {
 public:
  /// Labels stay inside `frame`.
  explicit LabelPlacement(const Box& frame) : frame_(frame) {}

  /// Something that labels must not cover.
  void block(const Box& box) { taken_.push_back(box); }

  /// Where the label of a point (x, y) of the given marker radius goes; the place is taken from now on.
  Box place(double x, double y, double radius, double width, double height);

 private:
  Box frame_;
  std::vector<Box> taken_;
};

}  // namespace radiosity

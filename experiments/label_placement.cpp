#include "experiments/label_placement.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace radiosity {

double overlap(const Box& a, const Box& b) {
  const double width = std::min(a.right, b.right) - std::max(a.left, b.left);
  const double height = std::min(a.bottom, b.bottom) - std::max(a.top, b.top);
  return width > 0 && height > 0 ? width * height : 0;
}

double text_width(std::string_view text, double size) {
  constexpr std::string_view narrow = "iljtfrI.,:;'!|()[] -";
  constexpr std::string_view wide = "mwMW@%";
  double em = 0;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xC0) == 0x80) continue;  // inside a UTF-8 sequence
    em += narrow.find(c) != std::string_view::npos ? 0.34
          : wide.find(c) != std::string_view::npos ? 0.88
                                                   : 0.63;
  }
  return em * size;
}

Box LabelPlacement::place(double x, double y, double radius, double width, double height) {
  // Beside first, then above and below, then the corners; horizontally -1 is left of the point, +1 right of
  // it.
  struct Place {
    double across;
    double down;
  };
  constexpr std::array<Place, 8> places = {
      {{1, 0}, {-1, 0}, {0, -1}, {0, 1}, {1, -1}, {1, 1}, {-1, -1}, {-1, 1}}};
  Box best;
  double least = std::numeric_limits<double>::infinity();
  for (const double distance : {1.0, 2.8}) {
    for (const Place& place : places) {
      const bool corner = place.across != 0 && place.down != 0;
      const double gap = radius + (corner ? 1 : 3) * distance;
      const double left = x + place.across * gap -
                          (place.across == 0  ? 0.5
                           : place.across < 0 ? 1
                                              : 0) *
                              width;
      const double top = y + place.down * gap - (place.down == 0 ? 0.5 : place.down < 0 ? 1 : 0) * height;
      const Box box{left, top, left + width, top + height};
      double cost = 4 * (width * height - overlap(box, frame_));
      for (const Box& other : taken_) cost += overlap(box, other);
      if (cost < least - 1e-9) {
        least = cost;
        best = box;
      }
    }
  }
  taken_.push_back(best);
  return best;
}

}  // namespace radiosity

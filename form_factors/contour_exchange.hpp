#pragma once

#include "form_factors/convex_polygon.hpp"

namespace radiosity {

/// A_i F_ij between two convex polygons with nothing in between, by the double contour integral
/// 1/(2 pi) oint oint ln r dx . dy. Every point of each must lie on or in front of the other's plane (clip
/// before). Exact to rounding where all edges are parallel or meet; else to about `tolerance` of the smaller
/// area.
double contour_exchange(const ConvexPolygon& first, const ConvexPolygon& second, double tolerance);

}  // namespace radiosity

#pragma once

#include "factorizations/function_family.hpp"

#include <vector>

namespace radiosity {

/// Items with places in a rectangle.
struct PlacedSet {
  std::vector<Eigen::Index> items;
  Eigen::Matrix2Xd places;  ///< one column an item, in [0, 1] x [0, 1]
  double aspect = 1;        ///< width over height of the rectangle; infinite for a line
};

/// Products of cosines cos(pi p x) cos(pi q y) on each of some disjoint sets, times `root_weight` (n, > 0):
/// as many as there are items. On a grid with equal weights, or on equidistant places on a line, this is the
/// orthonormal basis of the discrete cosine transform (DCT-II) in two or one dimensions; elsewhere the
/// functions of lowest frequency, which are only nearly orthogonal.
FunctionFamily cosines(std::vector<PlacedSet> sets, const Eigen::VectorXd& root_weight);

}  // namespace radiosity

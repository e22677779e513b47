#pragma once

#include "scene/scene.hpp"

#include <vector>

namespace radiosity {

/// For each point the index of the first earlier point (or itself) that is not farther than `tolerance` from
/// it. Points are taken in order, so the result is the same in every run. O(n).
std::vector<int> weld(const std::vector<Vector3>& points, double tolerance);

}  // namespace radiosity

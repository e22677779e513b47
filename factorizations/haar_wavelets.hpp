#pragma once

#include "factorizations/function_family.hpp"

#include <vector>

namespace radiosity {

/// Haar's wavelets on a partition of n items into sets: on each set a constant, and for its sequence cut into
/// halves again and again (the first half has the smaller number) the difference between either half. Halves
/// of unequal size or weight give unbalanced wavelets: each is a step function times `root_weight` (n, > 0),
/// and all n are orthonormal.
FunctionFamily haar_wavelets(const std::vector<std::vector<Eigen::Index>>& sets,
                             const Eigen::VectorXd& root_weight);

}  // namespace radiosity

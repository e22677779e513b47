#pragma once

#include <Eigen/Core>

#include <vector>

namespace radiosity {

/// The columns of `coordinates` (d x n) in a sequence whose halves, halves of halves and so on are compact:
/// each part is cut across the coordinate in which it extends most, the first half having the smaller number
/// of an odd one. Deterministic: equal coordinates keep their order.
std::vector<Eigen::Index> halving_order(const Eigen::MatrixXd& coordinates);

}  // namespace radiosity

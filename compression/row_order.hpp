#pragma once

#include <Eigen/Core>

#include <vector>

namespace radiosity {

/// Orders of rows in which similar ones are neighbours, by symmetric n x n matrices of squared distances; the
/// row at place p is order[p].

/// Document 000, section 3.5: the first row stays; next comes the nearest of those not yet placed, of
/// equally near ones the first.
std::vector<Eigen::Index> greedy_order(const Eigen::MatrixXd& squared_distances);

/// The Euclidean distances (their squares' roots) between neighbours, summed: what section 3.5 would minimize
/// over all orders.
double path_length(const Eigen::MatrixXd& squared_distances, const std::vector<Eigen::Index>& order);

/// A shorter path by 2-opt (Croes 1958): parts of it are turned around while that shortens it, looking from
/// each row at its 10 nearest only; at most `passes` times over all rows. The first row stays. Throws
/// UsageError for a start that is not an order of the rows.
std::vector<Eigen::Index> two_opt_order(const Eigen::MatrixXd& squared_distances,
                                        std::vector<Eigen::Index> start, int passes = 50);

}  // namespace radiosity

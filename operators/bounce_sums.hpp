#pragma once

#include "foundation/spec.hpp"

#include <Eigen/Core>

#include <optional>
#include <string>

namespace radiosity {

/// A number of bounces; empty: all of them.
using BounceCount = std::optional<long>;

/// Takes `key` of a spec: a number from 1 to 1000 or inf. Throws UsageError for anything else.
BounceCount take_bounces(Spec& spec, const std::string& key, long fallback);
std::string bounce_text(const BounceCount& bounces);

/// Bytes that bounce_sum() of n patches takes while it is computed, F and its result among them.
double bounce_sum_bytes(Eigen::Index n, const BounceCount& bounces);

/// sum over h = 1 ... k of (F^c)^h for one channel, n x n (document 000, Eq. 5 to 8): F C + F R F C + ...
/// with `reflectance` and sender `colours` of the channel (operators/colour_operator.hpp), in double. Takes
/// O(n^3) a bounce, or a factor more than one for all. Throws Error where the sum of all bounces does not
/// exist.
Eigen::MatrixXd bounce_sum(const Eigen::MatrixXd& F, const Eigen::VectorXd& reflectance,
                           const Eigen::VectorXd& colours, const BounceCount& bounces);

}  // namespace radiosity

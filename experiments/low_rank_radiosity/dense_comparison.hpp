#pragma once

#include "experiments/low_rank_radiosity/low_rank_tables.hpp"

#include <vector>

namespace radiosity {

/// The errors of all sizes of the options, of those up to largest_dense_error rows by compare().
std::vector<DenseComparison> compare_with_dense(const LowRankTablesOptions& options,
                                                const OperatorRegistry& operators,
                                                const SolverRegistry& solvers, Monitor& monitor);

/// With the options' equal_size and lights.
DenseEquality measure_equality(const LowRankTablesOptions& options, Monitor& monitor);

}  // namespace radiosity

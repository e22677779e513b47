#pragma once

#include "experiments/low_rank_radiosity/error_study.hpp"
#include "experiments/low_rank_radiosity/error_study_problem.hpp"

#include <set>
#include <vector>

namespace radiosity {

/// The best of each rank on one problem: found with training lights of other seeds (options.training) and
/// each patch as a light, measured with the lights of the study.
std::vector<BestRankError> measure_bounds(const StudiedScene& scene, const StudiedProblem& studied,
                                          const std::set<Index>& ranks, const ErrorStudyOptions& options,
                                          Monitor& monitor);

}  // namespace radiosity

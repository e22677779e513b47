#pragma once

#include "experiments/low_rank_benchmark.hpp"
#include "kernels/segments.hpp"
#include "kernels/tall_matrix.hpp"

#include <cstdint>

namespace radiosity {

/// V and Y of one size in B = E - Y (V' E), rows sorted by patch.
struct SolvedFactors {
  Segments V;
  TallMatrix<float> Y;
};

/// Random numbers of the size of Y's, in as many equal segments: as fast as any.
SolvedFactors random_factors(const LowRankSize& size, std::uint64_t seed);

}  // namespace radiosity

#pragma once

#include "experiments/low_rank_radiosity/low_rank_tables.hpp"
#include "experiments/read_stream.hpp"
#include "kernels/segments.hpp"
#include "kernels/tall_matrix.hpp"

#include <vector>

namespace radiosity {

/// Times document 004's Algorithm 2 with V sparse and, where `full` is given, full: 1 and 3 columns of a
/// random E, with one thread and with all that are allowed. E is sorted by patch, as V and Y are. `stream`
/// measures the read bandwidth beside them; null: none.
std::vector<FrameTimes> time_frames(const TallMatrix<float>& Y, const Segments& V,
                                    const TallMatrix<float>* full, ReadStream* stream, double seconds);

}  // namespace radiosity

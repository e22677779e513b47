#pragma once

#include "experiments/low_rank_radiosity/low_rank_tables.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// Three significant digits, all digits of numbers above 100; a dash for what was not measured or printed.
std::string table_number(std::optional<double> number);

/// "13824 × 864".
std::string size_text(const LowRankSize& size);

/// A number of the frame that is asked for; empty where the size was not timed.
using FrameNumber = std::function<std::optional<double>(const FrameTimes&)>;
std::string frame_cell(const LowRankTableRow& row, int threads, Index columns, const FrameNumber& number);

/// full / sparse of the fastest times.
std::optional<double> sums_speedup(const FrameTimes& frame);
std::optional<double> frame_speedup(const FrameTimes& frame);

/// Frames a second at the fastest and at the median time.
std::optional<double> full_speed(const FrameTimes& frame);
std::optional<double> sparse_speed(const FrameTimes& frame);
std::optional<double> median_sparse_speed(const FrameTimes& frame);

/// Starts a line for each size: the memory of Y where its group begins (sizes of equal n k), and n x k.
std::vector<std::vector<std::string>> lines_by_memory(const std::vector<LowRankTableRow>& rows);

}  // namespace radiosity

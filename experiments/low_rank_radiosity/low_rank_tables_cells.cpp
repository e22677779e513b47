#include "experiments/low_rank_radiosity/low_rank_tables_cells.hpp"

#include <fmt/format.h>

namespace radiosity {

std::string table_number(std::optional<double> number) {
  constexpr double all_digits = 100;
  if (!number) return "–";
  return *number >= all_digits ? fmt::format("{:.0f}", *number) : fmt::format("{:.3g}", *number);
}

std::string size_text(const LowRankSize& size) {
  return fmt::format("{} × {}", size.rows, size.rank);
}

std::string frame_cell(const LowRankTableRow& row, int threads, Index columns, const FrameNumber& number) {
  const FrameTimes* frame = row.find(threads, columns);
  return table_number(frame != nullptr ? number(*frame) : std::nullopt);
}

std::optional<double> sums_speedup(const FrameTimes& frame) {
  if (!frame.full_sums) return std::nullopt;
  return frame.full_sums->min / frame.sparse_sums.min;
}

std::optional<double> frame_speedup(const FrameTimes& frame) {
  if (!frame.full_frame) return std::nullopt;
  return frame.full_frame->min / frame.sparse_frame.min;
}

std::optional<double> full_speed(const FrameTimes& frame) {
  if (!frame.full_frame) return std::nullopt;
  return 1 / frame.full_frame->min;
}

std::optional<double> sparse_speed(const FrameTimes& frame) {
  return 1 / frame.sparse_frame.min;
}

std::optional<double> median_sparse_speed(const FrameTimes& frame) {
  return 1 / frame.sparse_frame.median;
}

std::vector<std::vector<std::string>> lines_by_memory(const std::vector<LowRankTableRow>& rows) {
  std::vector<std::vector<std::string>> lines;
  lines.reserve(rows.size());
  Index group = 0;
  for (const LowRankTableRow& row : rows) {
    const Index entries = row.size.rows * row.size.rank;
    constexpr double megabyte = 1e6;
    const double megabytes = static_cast<double>(entries) * sizeof(float) / megabyte;
    lines.push_back(
        {entries == group ? "" : fmt::format("{} MB", table_number(megabytes)), size_text(row.size)});
    group = entries;
  }
  return lines;
}

}  // namespace radiosity

// low_rank_tables.json, low_rank_tables.csv.

#include "experiments/json_objects.hpp"
#include "experiments/low_rank_radiosity/low_rank_tables.hpp"
#include "foundation/output_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace radiosity {
namespace {

Json optional_timing_json(const std::optional<Timing>& timing) {
  if (!timing) return nullptr;
  return {{"min_seconds", timing->min}, {"median_seconds", timing->median}};
}

Json frame_json(const FrameTimes& frame) {
  return {{"threads", frame.threads},
          {"columns", frame.columns},
          {"full_sums", optional_timing_json(frame.full_sums)},
          {"sparse_sums", optional_timing_json(frame.sparse_sums)},
          {"full_frame", optional_timing_json(frame.full_frame)},
          {"sparse_frame", optional_timing_json(frame.sparse_frame)},
          {"full_bandwidth", or_null(frame.full_bandwidth)},
          {"sparse_bandwidth", or_null(frame.sparse_bandwidth)}};
}

Json dense_errors_json(const std::optional<DenseErrors>& errors) {
  if (!errors) return nullptr;
  return {{"radiosity_mean", errors->radiosity_mean},
          {"indirect_mean", errors->indirect_mean},
          {"largest_difference", errors->largest_difference}};
}

Json table_rows_json(const std::vector<LowRankTableRow>& rows) {
  Json list = Json::array();
  for (const LowRankTableRow& row : rows) {
    Json times = Json::array();
    for (const FrameTimes& frame : row.times) times.push_back(frame_json(frame));
    list.push_back({{"n", row.size.rows},
                    {"k", row.size.rank},
                    {"sparse_bytes", row.sparse_bytes},
                    {"full_bytes", row.full_bytes},
                    {"computed", row.computed},
                    {"factor_seconds", row.factor_seconds},
                    {"fold_seconds", row.fold_seconds},
                    {"errors", dense_errors_json(row.errors)},
                    {"times", times}});
  }
  return list;
}

std::string seconds_field(const std::optional<Timing>& timing) {
  return timing ? fmt::format("{:.6g},{:.6g}", timing->min, timing->median) : ",";
}

std::string csv_lines(const std::vector<LowRankTableRow>& rows) {
  std::string csv;
  for (const LowRankTableRow& row : rows)
    for (const FrameTimes& frame : row.times)
      csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", row.size.rows, row.size.rank, row.computed,
                         frame.threads, frame.columns, seconds_field(frame.full_sums),
                         seconds_field(frame.sparse_sums), seconds_field(frame.full_frame),
                         seconds_field(frame.sparse_frame));
  return csv;
}

}  // namespace

void write_low_rank_tables(const std::filesystem::path& folder, const LowRankTables& tables,
                           const DeviceResults* device) {
  Json json = {{"threads", tables.threads},
               {"load_before", tables.load_before},
               {"load_after", tables.load_after},
               {"resident_bytes", tables.resident_bytes},
               {"sizes", table_rows_json(tables.rows)},
               {"large_sizes", table_rows_json(tables.large_rows)}};
  if (device != nullptr) json["device"] = device_results_json(*device);
  write_json(folder / "low_rank_tables.json", json);
  OutputFile file(folder / "low_rank_tables.csv");
  file.stream() << "n,k,computed,threads,columns,full_sums_min,full_sums_median,sparse_sums_min,"
                   "sparse_sums_median,full_frame_min,full_frame_median,sparse_frame_min,"
                   "sparse_frame_median\n"
                << csv_lines(tables.rows) << csv_lines(tables.large_rows);
  file.commit();
}

}  // namespace radiosity

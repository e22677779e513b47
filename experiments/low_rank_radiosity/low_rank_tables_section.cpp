#include "experiments/device/device_benchmark.hpp"
#include "experiments/low_rank_radiosity/low_rank_tables.hpp"
#include "experiments/low_rank_radiosity/low_rank_tables_cells.hpp"
#include "experiments/low_rank_radiosity/published_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace radiosity {
namespace {

/// Our columns of graphics processors, by one column of E, with E and B on the device.
class DeviceColumns {
 public:
  explicit DeviceColumns(const DeviceResults* results) : results_(results) {}

  /// "GPU full", or with the renderer's name.
  std::string name(const std::string& kind = {}) const {
    return (results_ != nullptr ? results_->renderer : "GPU") + (kind.empty() ? "" : " " + kind);
  }
  template <typename Number>
  std::string cell(const LowRankSize& size, const Number& number) const {
    const DeviceFrames* frames = results_ != nullptr ? results_->find(size, 1) : nullptr;
    return table_number(frames != nullptr ? std::optional<double>(number(*frames)) : std::nullopt);
  }

 private:
  const DeviceResults* results_;
};

std::optional<double> device_sums_speedup(const DeviceFrames& frames) {
  if (!frames.full) return std::nullopt;
  return frames.full->sums.min / frames.sparse.sums.min;
}

std::optional<double> device_frame_speedup(const DeviceFrames& frames) {
  if (!frames.full) return std::nullopt;
  return frames.full->frame.min / frames.sparse.frame.min;
}

std::optional<double> device_full_speed(const DeviceFrames& frames) {
  if (!frames.full) return std::nullopt;
  return 1 / frames.full->frame.min;
}

double device_sparse_speed(const DeviceFrames& frames) {
  return 1 / frames.sparse.frame.min;
}

/// A table that begins with memory and size.
ReportTable sized_table(const std::vector<LowRankTableRow>& rows, std::string caption,
                        const std::string& command, const std::vector<std::string>& columns) {
  ReportTable table;
  table.caption = std::move(caption);
  table.command = command;
  table.columns = {"Y", "n × k"};
  table.columns.insert(table.columns.end(), columns.begin(), columns.end());
  table.text_columns = 2;
  table.rows = lines_by_memory(rows);
  return table;
}

/// Tables 1 and 2.
ReportTable speedup_table(const LowRankTables& tables, const std::string& caption, const std::string& command,
                          const FrameNumber& speedup, const DeviceColumns& device,
                          std::optional<double> (*device_speedup)(const DeviceFrames&),
                          std::span<const PublishedRatios> published) {
  ReportTable table = sized_table(
      tables.rows, caption, command,
      {"1 thread", fmt::format("{} threads", tables.threads), "RGB", "document: CPU", device.name(),
       "document: GPU", "document: sparse CPU/sparse GPU", "document: full CPU/sparse GPU"});
  for (std::size_t i = 0; i < tables.rows.size(); ++i) {
    const LowRankTableRow& row = tables.rows[i];
    const PublishedRatios* printed = published_row(published, row.size);
    const auto ratio = [&](double PublishedRatios::*member) {
      return printed != nullptr ? fmt::format("{:.2f}", printed->*member) : table_number({});
    };
    std::vector<std::string>& line = table.rows[i];
    line.insert(
        line.end(),
        {frame_cell(row, 1, 1, speedup), frame_cell(row, tables.threads, 1, speedup),
         frame_cell(row, tables.threads, 3, speedup), ratio(&PublishedRatios::full_to_sparse_cpu),
         device.cell(row.size, device_speedup), ratio(&PublishedRatios::full_to_sparse_gpu),
         ratio(&PublishedRatios::sparse_cpu_to_sparse_gpu), ratio(&PublishedRatios::full_cpu_to_sparse_gpu)});
  }
  return table;
}

/// The mean over sizes; empty if one was not timed.
std::optional<double> mean_speed(const LowRankTables& tables, int threads, Index columns,
                                 const FrameNumber& number) {
  double sum = 0;
  for (const LowRankTableRow& row : tables.rows) {
    const FrameTimes* frame = row.find(threads, columns);
    const std::optional<double> speed = frame != nullptr ? number(*frame) : std::nullopt;
    if (!speed) return std::nullopt;
    sum += *speed;
  }
  return sum / static_cast<double>(tables.rows.size());
}

std::vector<std::string> published_speeds(const PublishedSpeeds* printed) {
  std::vector<std::string> cells;
  cells.reserve(4);
  for (double PublishedSpeeds::*member : {&PublishedSpeeds::full_cpu, &PublishedSpeeds::sparse_cpu,
                                          &PublishedSpeeds::full_gpu, &PublishedSpeeds::sparse_gpu})
    cells.push_back(printed != nullptr ? fmt::format("{:.0f}", printed->*member) : table_number({}));
  return cells;
}

ReportTable table_3(const LowRankTables& tables, const DeviceColumns& device, const std::string& command) {
  const std::string all = fmt::format("{} threads", tables.threads);
  ReportTable table =
      sized_table(tables.rows,
                  "Table 3: frames a second, B = E − Y (VᵀE), at the fastest time; RGB: frames of three "
                  "columns with sparse V and all threads.",
                  command,
                  {"full, 1 thread", "sparse, 1 thread", "full, " + all, "sparse, " + all, "sparse, median",
                   "RGB", device.name("full"), device.name("sparse"), "document: CPU full",
                   "document: CPU sparse", "document: GPU full", "document: GPU sparse"});
  const std::vector<std::pair<FrameNumber, std::pair<int, Index>>> speeds = {
      {full_speed, {1, 1}},
      {sparse_speed, {1, 1}},
      {full_speed, {tables.threads, 1}},
      {sparse_speed, {tables.threads, 1}},
      {median_sparse_speed, {tables.threads, 1}},
      {sparse_speed, {tables.threads, 3}}};
  std::vector<std::string> average = {"", "Average"};
  for (const auto& [number, times] : speeds) {
    for (std::size_t i = 0; i < tables.rows.size(); ++i)
      table.rows[i].push_back(frame_cell(tables.rows[i], times.first, times.second, number));
    average.push_back(table_number(mean_speed(tables, times.first, times.second, number)));
  }
  table.rows.push_back(std::move(average));
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const bool last = i == tables.rows.size();
    const std::vector<std::string> printed = published_speeds(
        last ? &published_average() : published_row(published_table_3(), tables.rows[i].size));
    const LowRankSize size = last ? LowRankSize{} : tables.rows[i].size;
    table.rows[i].insert(table.rows[i].end(),
                         {device.cell(size, device_full_speed), device.cell(size, device_sparse_speed)});
    table.rows[i].insert(table.rows[i].end(), printed.begin(), printed.end());
  }
  return table;
}

std::optional<double> thread_speedup(const LowRankTableRow& row, int threads) {
  const FrameTimes* one = row.find(1, 1);
  const FrameTimes* all = row.find(threads, 1);
  if (one == nullptr || all == nullptr) return std::nullopt;
  return one->sparse_frame.min / all->sparse_frame.min;
}

ReportTable table_4(const LowRankTables& tables, const DeviceColumns& device, const std::string& command) {
  constexpr std::size_t largest = 3;
  const std::vector<LowRankTableRow> rows(
      tables.rows.end() - static_cast<std::ptrdiff_t>(std::min(largest, tables.rows.size())),
      tables.rows.end());
  ReportTable table = sized_table(
      rows,
      "Table 4: frames a second with sparse V on a second machine, and over Table 3's. Ours: all threads of "
      "this machine, and over one thread of it.",
      command,
      {fmt::format("{} threads", tables.threads), "over 1 thread", device.name(), "document: CPU", "speed-up",
       "document: GPU", "speed-up"});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const PublishedSecondMachine* printed = published_row(published_table_4(), rows[i].size);
    std::vector<std::string>& line = table.rows[i];
    line.insert(line.end(), {frame_cell(rows[i], tables.threads, 1, sparse_speed),
                             table_number(thread_speedup(rows[i], tables.threads)),
                             device.cell(rows[i].size, device_sparse_speed)});
    const auto cell = [&](auto member) {
      return printed != nullptr ? table_number(printed->*member) : table_number({});
    };
    line.insert(line.end(), {cell(&PublishedSecondMachine::cpu), cell(&PublishedSecondMachine::cpu_speedup),
                             cell(&PublishedSecondMachine::gpu), cell(&PublishedSecondMachine::gpu_speedup)});
  }
  return table;
}

const std::vector<std::string> build_columns = {"Y", "U, s", "Y of U, s"};

/// How Y came about and how long U and Y of U took.
void append_build(const LowRankTableRow& row, std::vector<std::string>& line) {
  const auto seconds = [&](double number) {
    return table_number(row.computed ? std::optional(number) : std::nullopt);
  };
  const std::string made = row.computed ? "computed" : "random";
  line.insert(line.end(), {row.times.empty() ? table_number({}) : made, seconds(row.factor_seconds),
                           seconds(row.fold_seconds)});
}

ReportTable table_5(const LowRankTables& tables, const DeviceColumns& device, const std::string& command) {
  ReportTable table =
      sized_table(tables.large_rows, "Table 5: frames a second of large scenes, sparse V.", command,
                  {"1 thread", fmt::format("{} threads", tables.threads), "RGB", device.name(),
                   "document: CPU", "document: GPU"});
  table.columns.insert(table.columns.end(), build_columns.begin(), build_columns.end());
  for (std::size_t i = 0; i < tables.large_rows.size(); ++i) {
    const LowRankTableRow& row = tables.large_rows[i];
    const PublishedSecondMachine* printed = published_row(published_table_5(), row.size);
    std::vector<std::string>& line = table.rows[i];
    line.insert(line.end(),
                {frame_cell(row, 1, 1, sparse_speed), frame_cell(row, tables.threads, 1, sparse_speed),
                 frame_cell(row, tables.threads, 3, sparse_speed), device.cell(row.size, device_sparse_speed),
                 table_number(printed != nullptr ? std::optional(printed->cpu) : std::nullopt),
                 table_number(printed != nullptr ? std::optional(printed->gpu) : std::nullopt)});
    append_build(row, line);
  }
  return table;
}

/// What the products reach of the memory's read bandwidth, with the speed-up that it leaves.
ReportTable bandwidth_table(const LowRankTables& tables, const std::vector<LowRankTableRow>& rows,
                            const std::string& command) {
  ReportTable table =
      sized_table(rows,
                  "Bytes of Y (and of full V) over the time of B, of the read bandwidth measured in the same "
                  "turns: above 1 where a cache helps. Smaller sizes, which caches hold, are left out.",
                  command,
                  {"full, 1 thread", "sparse, 1 thread", fmt::format("full, {} threads", tables.threads),
                   fmt::format("sparse, {} threads", tables.threads)});
  const FrameNumber full = [](const FrameTimes& frame) { return frame.full_bandwidth; };
  const FrameNumber sparse = [](const FrameTimes& frame) { return frame.sparse_bandwidth; };
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const int threads : {1, tables.threads}) {
      table.rows[i].push_back(frame_cell(rows[i], threads, 1, full));
      table.rows[i].push_back(frame_cell(rows[i], threads, 1, sparse));
    }
  return table;
}

ReportTable dense_error_table(const LowRankTables& tables, const LowRankTablesOptions& options,
                              const std::string& command) {
  ReportTable table =
      sized_table(tables.rows,
                  fmt::format("Error along n k = const: mean relative error over {} area lights of uniform "
                              "2MSC against the dense solution with its own F, bytes of Y and V, and the "
                              "time that U and Y take. What is random is as fast.",
                              options.lights.total()),
                  command, {"error in B", "error in B − E", "sparse MB", "full MB"});
  table.columns.insert(table.columns.end(), build_columns.begin(), build_columns.end());
  for (std::size_t i = 0; i < tables.rows.size(); ++i) {
    const LowRankTableRow& row = tables.rows[i];
    const auto megabytes = [&](std::size_t bytes) {
      return table_number(row.times.empty() ? std::nullopt
                                            : std::optional(1e-6 * static_cast<double>(bytes)));
    };
    const auto error = [&](double DenseErrors::*member) {
      return row.errors ? fmt::format("{:.1e}", (*row.errors).*member) : table_number({});
    };
    std::vector<std::string>& line = table.rows[i];
    line.insert(line.end(), {error(&DenseErrors::radiosity_mean), error(&DenseErrors::indirect_mean),
                             megabytes(row.sparse_bytes), megabytes(row.full_bytes)});
    append_build(row, line);
  }
  return table;
}

std::string device_sentence(const DeviceResults* device) {
  if (device == nullptr)
    return "Columns called GPU are filled by radiosity bench --device gl --json FILE and --device-results "
           "FILE.";
  return device_text(*device).text + " E and B stay there; transfers are in a table below.";
}

std::string method_text(const LowRankTables& tables, const DeviceResults* device) {
  return fmt::format(
      "Document 004's Algorithm 2 on a cube of equal elements and uniform patches, n and k its own: X = VᵀE, "
      "then "
      "B = E − Y X, Y and full V in float32, one column, and three for RGB (of one grey reflectance, so that "
      "Y is "
      "the same). Its CPU code is sequential: compare it with one thread; {} threads are all that were "
      "allowed. "
      "Times are the fastest of turns that all products take side by side (medians in low_rank_tables.json); "
      "E is "
      "sorted by patch. Sizes of one group take the same memory. 442368, 1769472, 432 and 1728 are 12 m², of "
      "squares cut in two. {} Machine load {:.1f} to {:.1f}; at "
      "most "
      "{:.2f} GB were resident.",
      tables.threads, device_sentence(device), tables.load_before, tables.load_after,
      1e-9 * tables.resident_bytes);
}

/// What n = k, where 2MSC approximates nothing, gives; empty if there is no such size.
std::string equality_text(const LowRankTables& tables) {
  for (const LowRankTableRow& row : tables.rows)
    if (row.size.rows == row.size.rank && row.errors)
      return fmt::format(
          "With n = k = {} B is the dense solution: the largest relative difference of an element is {:.1e}, "
          "the "
          "rounding of Y in float32.",
          row.size.rows, row.errors->largest_difference);
  return {};
}

}  // namespace

ReportSection low_rank_tables_section(const LowRankTables& tables, const LowRankTablesOptions& options,
                                      const std::string& command) {
  ReportSection section{"Low-rank radiosity with sparse matrices: Tables 1 to 5 of document 004", {}};
  section.blocks.emplace_back(ReportText{method_text(tables, options.device.get())});
  const DeviceColumns device(options.device.get());
  section.blocks.emplace_back(
      speedup_table(tables, "Table 1: time of VᵀE with full V over that with sparse V.", command,
                    sums_speedup, device, device_sums_speedup, published_table_1()));
  section.blocks.emplace_back(speedup_table(tables, "Table 2: time of B with full V over that with sparse V.",
                                            command, frame_speedup, device, device_frame_speedup,
                                            published_table_2()));
  section.blocks.emplace_back(table_3(tables, device, command));
  section.blocks.emplace_back(table_4(tables, device, command));
  section.blocks.emplace_back(table_5(tables, device, command));
  if (options.device) section.blocks.emplace_back(device_frames_table(*options.device, command));
  std::vector<LowRankTableRow> all = tables.rows;
  std::copy(tables.large_rows.begin(), tables.large_rows.end(), std::back_inserter(all));
  section.blocks.emplace_back(bandwidth_table(tables, all, command));
  section.blocks.emplace_back(dense_error_table(tables, options, command));
  if (const std::string text = equality_text(tables); !text.empty())
    section.blocks.emplace_back(ReportText{text});
  return section;
}

}  // namespace radiosity

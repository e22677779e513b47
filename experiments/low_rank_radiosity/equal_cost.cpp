#include "experiments/low_rank_radiosity/equal_cost.hpp"

#include "experiments/comparison.hpp"
#include "experiments/json_objects.hpp"
#include "form_factors/form_factors.hpp"
#include "foundation/error.hpp"
#include "foundation/output_file.hpp"
#include "scene/built_in.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

/// a and b of y = a + b x, by least squares.
std::pair<double, double> line_through(const std::vector<CostedOperator>& operators,
                                       double CostedOperator::*cost) {
  const auto count = static_cast<double>(operators.size());
  double x_mean = 0, y_mean = 0;
  for (const CostedOperator& op : operators) {
    x_mean += static_cast<double>(op.k) / count;
    y_mean += op.*cost / count;
  }
  double covariance = 0, variance = 0;
  for (const CostedOperator& op : operators) {
    const double x = static_cast<double>(op.k) - x_mean;
    covariance += x * (op.*cost - y_mean);
    variance += x * x;
  }
  const double slope = covariance / variance;
  return {y_mean - slope * x_mean, slope};
}

/// Half of the smallest rank to four times the largest, each 1.41 times the one before.
std::vector<Index> one_sided_ranks(const EqualCostOptions& options) {
  const double first = static_cast<double>(options.ranks.front()) / 2;
  const double last = 4 * static_cast<double>(options.ranks.back());
  const auto steps = static_cast<int>(std::lround(2 * std::log2(last / first)));
  std::vector<Index> ranks;
  ranks.reserve(static_cast<std::size_t>(steps) + 1);
  for (int step = 0; step <= steps; ++step)
    ranks.push_back(
        std::min<Index>(static_cast<Index>(std::lround(first * std::exp2(0.5 * step))), options.patches));
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  return ranks;
}

CostedOperator costed(Index k, const ComparisonResult& result) {
  return {k, static_cast<double>(result.bytes), result.apply.min, result.errors.radiosity_mean.value_or(0)};
}

std::vector<EqualCostRow> measure_scene(const std::string& scene, const EqualCostOptions& options,
                                        const OperatorRegistry& operators, const SolverRegistry& solvers,
                                        Monitor& monitor) {
  const auto mesh =
      std::make_shared<const PatchMesh>(make_patches(built_in_scene(scene), {.patches = options.patches}));
  const FormFactors form_factors = compute_form_factors(mesh, {.seed = options.seed}, monitor);
  ComparisonOptions comparison;
  comparison.lights = options.lights;
  comparison.seed = options.seed;
  comparison.largest_measured = 0;
  comparison.machine = Machine{};
  const std::vector<Index> ladder = one_sided_ranks(options);
  for (const Index k : ladder) comparison.operators.push_back(fmt::format("sparse-v:k={}", k));
  for (const Index k : options.ranks) comparison.operators.push_back(fmt::format("2msc:k={},sides=two", k));
  const Comparison compared = compare(form_factors, operators, solvers, comparison, monitor);

  std::vector<CostedOperator> one_sided;
  for (std::size_t i = 0; i < ladder.size(); ++i) one_sided.push_back(costed(ladder[i], compared.results[i]));
  std::vector<EqualCostRow> rows;
  for (std::size_t i = 0; i < options.ranks.size(); ++i) {
    EqualCostRow row{
        scene, mesh->patch_count(), costed(options.ranks[i], compared.results[ladder.size() + i]), {}, {},
        {}};
    for (const CostedOperator& same : one_sided)
      if (same.k == row.two_sided.k) row.at_equal_rank = EqualCost{static_cast<double>(same.k), same.error};
    row.at_equal_bytes = at_equal_cost(one_sided, &CostedOperator::bytes, row.two_sided.bytes);
    row.at_equal_time = at_equal_cost(one_sided, &CostedOperator::seconds, row.two_sided.seconds);
    rows.push_back(row);
  }
  return rows;
}

std::string error_cell(const std::optional<EqualCost>& equal) {
  return equal ? fmt::format("{:.4f} ({:.0f})", equal->error, equal->k) : "–";
}

std::string gain_cell(const std::optional<EqualCost>& equal, const CostedOperator& two_sided) {
  return equal && two_sided.error > 0 ? fmt::format("{:.2f}", equal->error / two_sided.error) : "–";
}

ReportSection equal_cost_section(const std::vector<EqualCostRow>& rows, const std::string& command) {
  ReportTable table;
  table.caption =
      "Mean error in B of the two-sided 2MSC and of the one-sided with V sparse (its k): of the same k, with "
      "as "
      "many bytes, with as long a product. Gain: how many times larger the one-sided error is.";
  table.command = command;
  table.columns = {"scene",  "k",          "bytes a patch", "product, us", "two-sided",
                   "same k", "same bytes", "gain",          "same time",   "gain"};
  for (const EqualCostRow& row : rows)
    table.rows.push_back({fmt::format("{}, n = {}", row.scene, row.patches), std::to_string(row.two_sided.k),
                          fmt::format("{:.0f}", row.two_sided.bytes / static_cast<double>(row.patches)),
                          fmt::format("{:.1f}", 1e6 * row.two_sided.seconds),
                          fmt::format("{:.4f}", row.two_sided.error), error_cell(row.at_equal_rank),
                          error_cell(row.at_equal_bytes), gain_cell(row.at_equal_bytes, row.two_sided),
                          error_cell(row.at_equal_time), gain_cell(row.at_equal_time, row.two_sided)});
  ReportSection section{"Two-sided 2MSC at equal cost", {}};
  section.blocks.emplace_back(ReportText{
      "T P + P T − P T P keeps one factor of n × k, as the one-sided operator with V sparse does, and reads "
      "it "
      "twice a product. Whether what it gains is worth that depends on what is scarce: bytes or time."});
  section.blocks.emplace_back(std::move(table));
  return section;
}

Json equal_json(const std::optional<EqualCost>& equal) {
  if (!equal) return nullptr;
  return {{"k", equal->k}, {"error", equal->error}};
}

}  // namespace

std::optional<EqualCost> at_equal_cost(const std::vector<CostedOperator>& one_sided,
                                       double CostedOperator::*cost, double wanted) {
  if (one_sided.size() < 2) fail<UsageError>("a line through costs needs two operators at least");
  const auto [base, slope] = line_through(one_sided, cost);
  if (!(slope > 0)) return std::nullopt;
  const double k = (wanted - base) / slope;
  for (std::size_t i = 1; i < one_sided.size(); ++i) {
    const CostedOperator &low = one_sided[i - 1], &high = one_sided[i];
    const auto from = static_cast<double>(low.k), to = static_cast<double>(high.k);
    if (k < from || k > to || low.error <= 0 || high.error <= 0) continue;
    const double at = std::log(k / from) / std::log(to / from);
    return EqualCost{k, std::exp((1 - at) * std::log(low.error) + at * std::log(high.error))};
  }
  return std::nullopt;
}

std::vector<EqualCostRow> measure_equal_cost(const EqualCostOptions& options,
                                             const OperatorRegistry& operators, const SolverRegistry& solvers,
                                             Monitor& monitor) {
  if (options.ranks.empty()) fail<UsageError>("operators at equal cost need one rank at least");
  std::vector<EqualCostRow> rows;
  for (const std::string& scene : options.scenes)
    for (EqualCostRow& row : measure_scene(scene, options, operators, solvers, monitor))
      rows.push_back(std::move(row));
  return rows;
}

ReportSection equal_cost(const std::filesystem::path& folder, const std::string& command,
                         const EqualCostOptions& options, const OperatorRegistry& operators,
                         const SolverRegistry& solvers, Monitor& monitor) {
  make_folder(folder);
  const std::vector<EqualCostRow> rows = measure_equal_cost(options, operators, solvers, monitor);
  Json list = Json::array();
  for (const EqualCostRow& row : rows)
    list.push_back({{"scene", row.scene},
                    {"patches", row.patches},
                    {"k", row.two_sided.k},
                    {"bytes", row.two_sided.bytes},
                    {"seconds", row.two_sided.seconds},
                    {"error", row.two_sided.error},
                    {"at_equal_rank", equal_json(row.at_equal_rank)},
                    {"at_equal_bytes", equal_json(row.at_equal_bytes)},
                    {"at_equal_time", equal_json(row.at_equal_time)}});
  write_json(folder / "low_rank_sides.json", {{"load", load_average()}, {"rows", list}});
  return equal_cost_section(rows, command);
}

}  // namespace radiosity

// dxt_errors.json, dxt_errors.csv.

#include "experiments/dxt_radiosity/dxt_errors.hpp"
#include "experiments/json_objects.hpp"
#include "foundation/output_file.hpp"
#include "operators/bounce_sums.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace radiosity {
namespace {

Json histogram_json(const Histogram& histogram) {
  return {{"low", histogram.low},
          {"high", histogram.high},
          {"below", histogram.below},
          {"counts", histogram.counts}};
}

Json answer_errors_json(const std::optional<AnswerErrors>& errors) {
  if (!errors) return nullptr;
  return {{"radiosity", errors->radiosity}, {"indirect", errors->indirect}};
}

Json reorderings_json(const DxtErrors& errors) {
  Json list = Json::array();
  for (const ReorderingRow& row : errors.reorderings)
    list.push_back({{"start", row.order.start},
                    {"reorder", row.order.reorder},
                    {"average", row.errors.average},
                    {"largest", row.errors.largest},
                    {"total", row.errors.total},
                    {"bytes_per_entry", row.bytes_per_entry}});
  return list;
}

Json exact_parts_json(const DxtErrors& errors) {
  Json list = Json::array();
  for (const ExactPartRow& row : errors.exact_parts)
    list.push_back({{"exact", row.exact},
                    {"without_order", row.without_order},
                    {"ordered", row.ordered},
                    {"filled", row.filled}});
  return list;
}

Json bounces_json(const DxtErrors& errors) {
  Json list = Json::array();
  for (const BouncesRow& row : errors.bounces)
    list.push_back({{"variant", row.variant},
                    {"bounces", bounce_text(row.bounces)},
                    {"summed", answer_errors_json(row.summed)},
                    {"iterated", answer_errors_json(row.iterated)}});
  return list;
}

Json steps_json(const DxtErrors& errors) {
  Json list = Json::array();
  for (const ImprovementStep& step : errors.steps)
    list.push_back({{"change", step.change},
                    {"spec", step.answer.spec},
                    {"bytes", step.answer.bytes},
                    {"operator_error", or_null(step.answer.operator_error)},
                    {"errors", answer_errors_json(step.answer.errors)},
                    {"errors_at_high_reflectance", answer_errors_json(step.at_high.errors)},
                    {"refusal", step.answer.refusal},
                    {"refusal_at_high_reflectance", step.at_high.refusal}});
  return list;
}

std::string csv_errors(const std::optional<AnswerErrors>& errors) {
  return errors ? fmt::format("{:.6g},{:.6g}", errors->radiosity, errors->indirect) : ",";
}

}  // namespace

void write_dxt_errors(const std::filesystem::path& folder, const DxtErrors& errors) {
  write_json(folder / "dxt_errors.json", {{"scene", errors.scene},
                                          {"patches", errors.patches},
                                          {"histograms",
                                           {{"factors", histogram_json(errors.histograms.factors)},
                                            {"logarithms", histogram_json(errors.histograms.logarithms)},
                                            {"normalized", histogram_json(errors.histograms.normalized)},
                                            {"codes", histogram_json(errors.histograms.codes)},
                                            {"below_0.005", errors.histograms.small},
                                            {"beyond_range", errors.histograms.beyond}}},
                                          {"reorderings", reorderings_json(errors)},
                                          {"largest_compressed", errors.largest_compressed},
                                          {"exact_parts", exact_parts_json(errors)},
                                          {"bounces", bounces_json(errors)},
                                          {"steps", steps_json(errors)}});
  OutputFile file(folder / "dxt_errors.csv");
  file.stream() << "spec,bytes,operator_error,radiosity,indirect,radiosity_high,indirect_high\n";
  for (const ImprovementStep& step : errors.steps)
    file.stream() << fmt::format(
        "\"{}\",{},{},{},{}\n", step.answer.spec, step.answer.bytes,
        step.answer.operator_error ? fmt::format("{:.6g}", *step.answer.operator_error) : "",
        csv_errors(step.answer.errors), csv_errors(step.at_high.errors));
  file.commit();
}

}  // namespace radiosity

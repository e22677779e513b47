#include "experiments/dxt_radiosity/dxt_errors.hpp"

#include "experiments/dxt_radiosity/improvement_steps.hpp"
#include "foundation/error.hpp"
#include "foundation/output_file.hpp"
#include "operators/bounce_sums.hpp"
#include "scene/built_in.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace radiosity {
namespace {

CompressedColours compressed_in_order(const std::vector<ColourMatrix>& matrices, const PatchMesh& mesh,
                                      const TexelOrderChoice& order,
                                      const ColourCompressionOptions& compression) {
  return compress_colours(matrices, compression, make_texel_order(order, mesh));
}

std::vector<ReorderingRow> measure_reorderings(const std::vector<ColourMatrix>& matrices,
                                               const PatchMesh& mesh, std::uint64_t seed, Monitor& monitor) {
  const auto random_seed = static_cast<std::int64_t>(seed);
  const std::vector<TexelOrderChoice> orders = {{"none", "random", random_seed},
                                                {"rows", "random", random_seed},
                                                {"both", "random", random_seed},
                                                {"2opt", "random", random_seed},
                                                {"none", "face", 1},
                                                {"rows", "face", 1},
                                                {"both", "face", 1},
                                                {"morton", "face", 1}};
  std::vector<ReorderingRow> rows;
  for (const TexelOrderChoice& order : orders) {
    monitor.checkpoint("orders of rows and columns",
                       static_cast<double>(rows.size()) / static_cast<double>(orders.size()));
    const CompressedColours compressed = compressed_in_order(matrices, mesh, order, {});
    rows.push_back({order, entry_errors(matrices, compressed), bytes_per_entry(compressed)});
  }
  return rows;
}

std::vector<ExactPartRow> measure_exact_parts(const std::vector<ColourMatrix>& matrices,
                                              const PatchMesh& mesh, const std::vector<double>& parts,
                                              Monitor& monitor) {
  std::vector<ExactPartRow> rows;
  for (const double exact : parts) {
    monitor.checkpoint("exact parts", static_cast<double>(rows.size()) / static_cast<double>(parts.size()));
    const auto total = [&](const char* reorder, const ColourCompressionOptions& compression) {
      return entry_errors(matrices, compressed_in_order(matrices, mesh, {.reorder = reorder}, compression))
          .total;
    };
    const ColourCompressionOptions document{.exact = exact};
    const ColourCompressionOptions filled{.range = 0, .exact = exact, .fill = true, .fit = Bc1Fit::cluster};
    rows.push_back({exact, total("none", document), total("both", document), total("morton", filled)});
  }
  return rows;
}

/// "dxt:range=6" and "bounces=3": "dxt:range=6,bounces=3".
std::string with_bounces(const std::string& spec, const BounceCount& bounces) {
  return fmt::format("{}{}bounces={}", spec, spec.find(':') == std::string::npos ? ":" : ",",
                     bounce_text(bounces));
}

BouncesRow measure_bounces(const std::string& variant, const BounceCount& bounces, const LitScene& scene,
                           const LinearOperator& exact, const LinearOperator& one_bounce,
                           const OperatorRegistry& operators, const SolverRegistry& solvers,
                           Monitor& monitor) {
  BouncesRow row{bounces, variant, {}, {}};
  const Field reference = bounces ? after_bounces(exact, scene.emission, *bounces) : scene.reference;
  const auto errors_of = [&](const Field& radiosity) {
    return answer_errors(scene.mesh(), scene.emission, radiosity, reference);
  };
  if (bounces)
    row.iterated = errors_of(after_bounces(one_bounce, scene.emission, *bounces));
  else
    row.iterated = operator_answer(variant, scene, false, operators, solvers, monitor).errors;
  if (bounces == 1L) {  // S_1 - I is F^c itself
    row.summed = *row.iterated;
    return row;
  }
  const auto sum = operators.make(with_bounces(variant, bounces), scene.form_factors);
  Field radiosity(scene.emission.rows(), scene.emission.cols());
  sum->apply(scene.emission, radiosity);
  row.summed = errors_of(radiosity);
  return row;
}

std::vector<BouncesRow> measure_all_bounces(const LitScene& scene, const std::vector<long>& counts,
                                            const OperatorRegistry& operators, const SolverRegistry& solvers,
                                            Monitor& monitor) {
  std::vector<BounceCount> all(counts.begin(), counts.end());
  all.push_back(std::nullopt);
  const auto exact = operators.make("dense", scene.form_factors);
  std::vector<BouncesRow> rows;
  for (const std::string variant : {document_variant, improved_variant}) {
    const auto one_bounce = operators.make(variant, scene.form_factors);
    for (const BounceCount& bounces : all) {
      monitor.checkpoint("bounces of " + variant, 0);
      rows.push_back(
          measure_bounces(variant, bounces, scene, *exact, *one_bounce, operators, solvers, monitor));
    }
  }
  return rows;
}

}  // namespace

const ReorderingRow& DxtErrors::reordering(const std::string& start, const std::string& reorder) const {
  for (const ReorderingRow& row : reorderings)
    if (row.order.start == start && row.order.reorder == reorder) return row;
  fail("no order start={},reorder={} was measured", start, reorder);
}

const ImprovementStep& DxtErrors::step(const std::string& spec) const {
  for (const ImprovementStep& own : steps)
    if (own.answer.spec == spec) return own;
  fail("'{}' was not measured", spec);
}

DxtErrors measure_dxt_errors(const DxtErrorsOptions& options, const OperatorRegistry& operators,
                             const SolverRegistry& solvers, Monitor& monitor) {
  const auto mesh = std::make_shared<const PatchMesh>(
      make_patches(built_in_scene(options.scene), {.patches = options.patches}));
  if (mesh->channels() != 3) fail<UsageError>("{} is grey: DXT1 stores three channels", options.scene);
  const FormFactors form_factors = compute_form_factors(mesh, {.seed = options.seed}, monitor);
  const std::vector<ColourMatrix> matrices = colour_form_factors(form_factors);
  const double document_exact = ColourCompressionOptions{}.exact;

  DxtErrors errors{.scene = options.scene,
                   .patches = mesh->patch_count(),
                   .histograms = entry_histograms(form_factors, matrices, document_exact),
                   .reorderings = measure_reorderings(matrices, *mesh, options.seed, monitor),
                   .largest_compressed = largest_compressed_entry(matrices, document_exact),
                   .exact_parts = measure_exact_parts(matrices, *mesh, options.exact_parts, monitor),
                   .bounces = {},
                   .steps = {}};
  const LitScene scene = lit_scene(form_factors, options.lights, options.seed, monitor);
  const LitScene bright = lit_scene(with_even_reflectance(form_factors, options.high_reflectance),
                                    options.lights, options.seed, monitor);
  errors.bounces = measure_all_bounces(scene, options.bounces, operators, solvers, monitor);
  for (const NamedVariant& variant : improvement_variants)
    errors.steps.push_back({variant.change,
                            operator_answer(variant.spec, scene, true, operators, solvers, monitor),
                            operator_answer(variant.spec, bright, false, operators, solvers, monitor)});
  return errors;
}

ReportSection dxt_errors(const std::filesystem::path& folder, const std::string& command,
                         const DxtErrorsOptions& options, const OperatorRegistry& operators,
                         const SolverRegistry& solvers, Monitor& monitor) {
  make_folder(folder);
  const DxtErrors errors = measure_dxt_errors(options, operators, solvers, monitor);
  write_dxt_errors(folder, errors);
  return dxt_errors_section(errors, options, command);
}

}  // namespace radiosity

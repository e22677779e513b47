#include "experiments/dxt_radiosity/dxt_errors_findings.hpp"

#include "experiments/dxt_radiosity/improvement_steps.hpp"
#include "experiments/dxt_radiosity/published_errors.hpp"

#include <fmt/format.h>

#include <limits>

namespace radiosity {
namespace {

constexpr double wanted_reordering_gain = 5;
constexpr double wanted_colour_gain = 10;
constexpr double wanted_kernel_error = 8e-4;
constexpr double wanted_closed_error = 2e-3;

std::string reached_or_not(bool reached) {
  return reached ? "reached" : "not reached";
}

double error_in_radiosity(const OperatorAnswer& answer) {
  return answer.errors ? answer.errors->radiosity : std::numeric_limits<double>::infinity();
}

/// The least error in B among the colour matrices of BC1 with at most the document's bytes.
const ImprovementStep& best_colour_step(const DxtErrors& errors) {
  const ImprovementStep* best = &errors.step(document_variant);
  const std::size_t bytes = best->answer.bytes;
  for (const ImprovementStep& step : errors.steps) {
    const std::string& spec = step.answer.spec;
    const bool colours_in_bc1 = spec.starts_with("dxt") && spec.find("matrix=kernel") == std::string::npos &&
                                spec.find("codec=") == std::string::npos;
    if (colours_in_bc1 && step.answer.bytes <= bytes &&
        error_in_radiosity(step.answer) < error_in_radiosity(best->answer))
      best = &step;
  }
  return *best;
}

/// The least error at high reflectance among variants of `dxt` with row sums restored.
const ImprovementStep& best_closed_step(const DxtErrors& errors) {
  const ImprovementStep* best = &errors.step(closed_kernel_variant);
  for (const ImprovementStep& step : errors.steps)
    if (step.answer.spec.starts_with("dxt") && step.answer.spec.find("closure=") != std::string::npos &&
        error_in_radiosity(step.at_high) < error_in_radiosity(best->at_high))
      best = &step;
  return *best;
}

}  // namespace

std::string histogram_finding(const DxtErrors& errors) {
  return fmt::format(
      "{:.2f} % of the form factors are below {}: they prevail, as the document says. Of what is compressed "
      "and not zero, {:.2g} % lie more than 25 natural logarithms below the largest and are lost as codes.",
      100 * errors.histograms.small, small_factor, 100 * errors.histograms.beyond);
}

std::string reordering_finding(const DxtErrors& errors) {
  const double random = errors.reordering("random", "none").errors.total;
  const double gain = random / errors.reordering("random", "both").errors.total;
  const double face = errors.reordering("face", "none").errors.total;
  return fmt::format(
      "From a random order, reordering by rows and columns makes the total error {:.1f} times smaller (the "
      "document: {:.1f} times; {} times is wanted, {}). Much of that is what the random order lost: patches "
      "in "
      "the order of their faces have an error {:.1f} times smaller without any search, {:.2f} times smaller "
      "after it, and curves on the faces, without a search, reach {:.1f} times.",
      gain, published_errors[0].total / published_errors[2].total, wanted_reordering_gain,
      reached_or_not(gain >= wanted_reordering_gain), random / face,
      random / errors.reordering("face", "both").errors.total,
      random / errors.reordering("face", "morton").errors.total);
}

std::string published_table_finding(const DxtErrors& errors) {
  std::string entries;
  for (const PublishedErrors& column : published_errors)
    entries += fmt::format("{}{:.2e}", entries.empty() ? "" : ", ", column.total / column.average);
  return fmt::format(
      "The document's table contradicts itself: total over average is the number of entries, and it prints "
      "{} "
      "of them for one matrix. A maximum of {} cannot be where the largest 4 % of each row are exact: here "
      "nothing above {:.2e} is compressed, and no error is larger than that.",
      entries, published_errors[0].largest, errors.largest_compressed);
}

std::string bytes_finding(const DxtErrors& errors) {
  const double bytes = errors.reordering("face", "both").bytes_per_entry;
  const double ratio = 4 / bytes;
  return fmt::format(
      "The document's variant takes {:.3f} bytes an entry of three colours: {:.2f} times less than one "
      "scalar "
      "matrix in float32 (the document: {} times; {}), {:.2f} times less than three.",
      bytes, ratio, published_memory_ratio, reached_or_not(ratio >= published_memory_ratio), 3 * ratio);
}

std::string bounces_finding(const DxtErrors& errors) {
  std::string text;
  for (const BouncesRow& row : errors.bounces) {
    if (row.bounces == 1L || !row.iterated) continue;
    text += fmt::format("{}{} of {}: {:.2f}", text.empty() ? "" : "; ",
                        row.bounces ? fmt::format("{} bounces", *row.bounces) : "all bounces", row.variant,
                        row.iterated->radiosity / row.summed.radiosity);
  }
  return "How many times larger the error in B is where the compressed one-bounce matrix is iterated than "
         "where "
         "the sum is compressed: " +
         text + ". Iterating amplifies what each bounce is off by; above 1 the sum is the better one.";
}

std::string improvement_finding(const DxtErrors& errors, const DxtErrorsOptions& options) {
  const OperatorAnswer& document = errors.step(document_variant).answer;
  const OperatorAnswer& best = best_colour_step(errors).answer;
  const OperatorAnswer& kernel = errors.step(kernel_variant).answer;
  const ImprovementStep& closed = best_closed_step(errors);
  const double gain = error_in_radiosity(document) / error_in_radiosity(best);
  return fmt::format(
      "At no more than the document's bytes, {} has an error in B of {:.2e}, {:.1f} times below the "
      "document's "
      "{:.2e} ({} times is wanted: {}). The kernel that all channels share, in BC4 ({}), errs by {:.2e} at "
      "{:.2f} of the bytes (at most {} is wanted: {}). With every reflectance {} the best with row sums "
      "restored is {}: {:.2e} "
      "(at most {} is wanted: {}).",
      best.spec, error_in_radiosity(best), gain, error_in_radiosity(document), wanted_colour_gain,
      reached_or_not(gain >= wanted_colour_gain), kernel.spec, error_in_radiosity(kernel),
      static_cast<double>(kernel.bytes) / static_cast<double>(document.bytes), wanted_kernel_error,
      reached_or_not(error_in_radiosity(kernel) <= wanted_kernel_error), options.high_reflectance,
      closed.answer.spec, error_in_radiosity(closed.at_high), wanted_closed_error,
      reached_or_not(error_in_radiosity(closed.at_high) <= wanted_closed_error));
}

}  // namespace radiosity

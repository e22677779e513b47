// The sentences of `low-rank-errors`: every number in them is counted or measured.

#include "experiments/low_rank_radiosity/error_study_findings.hpp"
#include "experiments/low_rank_radiosity/error_study_spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>

namespace radiosity {
namespace {

using Findings = std::vector<ProblemFindings>;

constexpr std::array<const char*, 3> kinds = {"area lights", "point lights", "single patches"};

/// Lowest and highest of a value of one factorization over the problems.
struct Range {
  std::optional<double> low;
  std::optional<double> high;

  void include(std::optional<double> value) {
    if (!value) return;
    low = low ? std::min(*low, *value) : *value;
    high = high ? std::max(*high, *value) : *value;
  }
  std::string text(const char* format) const {
    if (!low) return "not fitted";
    const std::string lowest = fmt::format(fmt::runtime(format), *low);
    const std::string highest = fmt::format(fmt::runtime(format), *high);
    return lowest == highest ? lowest : lowest + " to " + highest;
  }
};

template <typename Number, typename Value>
Number sum_over(const Findings& findings, const Value& value) {
  return std::accumulate(findings.begin(), findings.end(), Number{},
                         [&](Number sum, const ProblemFindings& one) { return sum + value(one); });
}

/// "QR of 2MSC 14, SVD 2", the most frequent first.
std::string wins_text(const Findings& findings, std::vector<LeastError> ProblemFindings::*list) {
  std::map<std::string, int> wins;
  for (const ProblemFindings& one : findings)
    for (const LeastError& least : one.*list) ++wins[least.factorization];
  std::vector<std::pair<std::string, int>> order(wins.begin(), wins.end());
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [name, count] : order)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, count);
  return text;
}

std::string optimality_answer(const Findings& findings) {
  const Index ranks = sum_over<Index>(findings, [](const auto& one) { return one.ranks; });
  const Index in_T = sum_over<Index>(findings, [](const auto& one) { return one.svd_least_in_T; });
  const Index beaten = sum_over<Index>(findings, [](const auto& one) { return one.svd_beaten_in_B; });
  const Index by_others = sum_over<Index>(findings, [](const auto& one) { return one.svd_beaten_by_others; });
  const auto strongest = std::max_element(findings.begin(), findings.end(), [](const auto& a, const auto& b) {
    return a.largest_gain < b.largest_gain;
  });
  double low = 0;
  double high = 0;
  for (const ProblemFindings& one : findings) {
    if (one.svd_over_best_low > 0)
      low = low == 0 ? one.svd_over_best_low : std::min(low, one.svd_over_best_low);
    high = std::max(high, one.svd_over_best_high);
  }
  std::string text = fmt::format(
      "Is SVD optimal? In T: SVD, plain or of the area norm, has the least error at {} of {} pairs of "
      "problem and k. In B: the mean error of plain SVD is beaten by more than 1 % by a factorization of no "
      "larger rank at {} of {}, by one that is not SVD in the area norm at {}",
      in_T, ranks, beaten, ranks, by_others);
  if (beaten > 0)
    text += fmt::format(", at most by a factor of {:.2g} ({}, {}, k = {:.0f})", strongest->largest_gain,
                        strongest->strongest_rival.factorization, strongest->problem.text(),
                        strongest->strongest_rival.cost);
  return text + fmt::format(
                    ". Its rms error in B is {:.2g} to {:.2g} times that of the best operator of the same "
                    "rank for such lights.",
                    low, high);
}

std::string winners_answer(const Findings& findings) {
  return fmt::format(
      "The least mean error in B, counted over problems and k. At equal k: {}. At the bytes of SVD: {}. (The "
      "two-sided 2MSC keeps one factor of n × k but has rank 2 k.)",
      wins_text(findings, &ProblemFindings::at_equal_rank),
      wins_text(findings, &ProblemFindings::at_equal_bytes));
}

std::string decay_answer(const Findings& findings) {
  std::string text = "How the error in T relates to the error in B, over all problems:";
  for (const char* name : {plain_svd, uniform_two_mesh}) {
    Range power;
    Range below;
    for (const ProblemFindings& one : findings)
      for (const ErrorDecay& decay : one.decays) {
        if (decay.factorization != name) continue;
        power.include(decay.over_operator_error);
        below.include(decay.below_operator_error);
      }
    text += fmt::format(
        "{} of {} the mean error in B falls as the error in T to the power {}, and is at the largest k {} "
        "times below it",
        name == plain_svd ? "" : ";", name, power.text("{:.2f}"), below.text("{:.2g}"));
  }
  return text + ".";
}

/// "1.2 to 3 for area lights, ..."
std::string over_alone_text(const Findings& findings, std::array<double, 3> ProblemFindings::*ratios) {
  std::string text;
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    Range range;
    for (const ProblemFindings& one : findings)
      if ((one.*ratios)[kind] > 0) range.include((one.*ratios)[kind]);
    text += fmt::format("{}{} for {}", text.empty() ? "" : ", ", range.text("{:.2g}"), kinds[kind]);
  }
  return text;
}

std::string alone_answer(const Findings& findings) {
  return fmt::format(
      "What a choice of lights gains: at the largest k the mean error in B, over that of the best operator "
      "of "
      "the same rank for lights of one kind alone, is with SVD {}; with uniform 2MSC {}.",
      over_alone_text(findings, &ProblemFindings::svd_over_alone),
      over_alone_text(findings, &ProblemFindings::two_mesh_over_alone));
}

std::string two_mesh_answer(const Findings& findings) {
  const Index ranks = sum_over<Index>(findings, [](const auto& one) { return one.ranks; });
  std::string text = "Where 2MSC wins and loses against SVD at equal k:";
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    Range ratio;
    for (const ProblemFindings& one : findings) ratio.include(one.two_mesh_ratio[kind]);
    text += fmt::format(
        "{} on {} uniform 2MSC has the smaller mean error in B at {} of {} (at the largest k {} times that "
        "of "
        "SVD)",
        kind == 0 ? "" : ";", kinds[kind],
        sum_over<Index>(findings, [&](const auto& one) { return one.two_mesh_wins[kind]; }), ranks,
        ratio.text("{:.2g}"));
  }
  return text + fmt::format(". The adaptive coarse mesh beats the uniform one at {} of {}.",
                            sum_over<Index>(findings, [](const auto& one) { return one.adaptive_wins; }),
                            ranks);
}

std::string spectrum_answer(const SpectrumStudy& spectrum) {
  const Index on_shelf = count_above_shelf(spectrum.eigenvalues);
  const Index left = count_above_shelf(spectrum.without_adjacent);
  const auto shown = std::min(spectrum.eigenvalues.size() - 1, static_cast<std::size_t>(on_shelf));
  return fmt::format(
      "Why: {} with {} patches has {} pairs that share an edge; {} eigenvalues of K exceed {} in magnitude "
      "({:.2f} a pair), and {} once those pairs are set to 0. Eigenvalue {} falls from {:.2g} to {:.2g}.",
      spectrum.scene, spectrum.patches, spectrum.adjacent_pairs, on_shelf, shelf_height,
      static_cast<double>(on_shelf) / static_cast<double>(std::max<Index>(spectrum.adjacent_pairs, 1)), left,
      shown, spectrum.eigenvalues[shown], spectrum.without_adjacent[shown]);
}

}  // namespace

std::vector<std::string> answers(const ErrorStudy& study) {
  const Findings findings = find_in_study(study);
  std::vector<std::string> texts = {optimality_answer(findings), winners_answer(findings),
                                    two_mesh_answer(findings), alone_answer(findings),
                                    decay_answer(findings)};
  for (const SpectrumStudy& spectrum : study.spectra) texts.push_back(spectrum_answer(spectrum));
  Index refused = 0;
  for (const LowRankError& row : study.factorizations) refused += row.errors ? 0 : 1;
  if (refused > 0)
    texts.push_back(fmt::format("{} of {} operators have no answer: Woodbury's formula refused them.",
                                refused, study.factorizations.size()));
  return texts;
}

}  // namespace radiosity

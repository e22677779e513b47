#include "experiments/low_rank_radiosity/error_study_findings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace radiosity {
namespace {

/// The rows of one factorization that have an answer, by rising k.
using RankedRows = std::vector<const LowRankError*>;

std::map<std::string, RankedRows> rows_of(const ErrorStudy& study, const ErrorStudyProblem& problem) {
  std::map<std::string, RankedRows> rows;
  for (const LowRankError& row : study.factorizations)
    if (row.problem == problem && row.errors) rows[row.factorization].push_back(&row);
  return rows;
}

const LowRankError* row_at(const RankedRows& rows, Index k) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const auto* row) { return row->k == k; });
  return found == rows.end() ? nullptr : *found;
}

/// The mean error in B that these bytes buy: interpolated between two ranks along a power law, that of the
/// largest rank where there are bytes to spare, none where they do not suffice for the smallest.
std::optional<double> error_for_bytes(const RankedRows& rows, double bytes) {
  const LowRankError* below = nullptr;
  for (const LowRankError* row : rows) {
    const double error = row->errors->radiosity_mean;
    if (row->bytes_per_patch > bytes) {
      if (below == nullptr) return std::nullopt;
      const double before = below->errors->radiosity_mean;
      if (before <= 0 || error <= 0) return before;
      const double part =
          std::log(bytes / below->bytes_per_patch) / std::log(row->bytes_per_patch / below->bytes_per_patch);
      return before * std::pow(error / before, part);
    }
    below = row;
  }
  return below == nullptr ? std::nullopt : std::optional<double>(below->errors->radiosity_mean);
}

void keep_least(std::optional<LeastError>& least, const LeastError& candidate) {
  if (!least || candidate.error < least->error) least = candidate;
}

std::vector<LeastError> least_at_equal_rank(const std::map<std::string, RankedRows>& rows) {
  std::map<Index, std::optional<LeastError>> least;
  for (const auto& [name, ranked] : rows)
    for (const LowRankError* row : ranked)
      keep_least(least[row->k], {static_cast<double>(row->k), name, row->errors->radiosity_mean});
  std::vector<LeastError> found;
  found.reserve(least.size());
  for (const auto& [k, winner] : least) found.push_back(*winner);
  return found;
}

std::vector<LeastError> least_at_equal_bytes(const std::map<std::string, RankedRows>& rows,
                                             const RankedRows& svd) {
  std::vector<LeastError> found;
  for (const LowRankError* budget : svd) {
    std::optional<LeastError> least;
    for (const auto& [name, ranked] : rows)
      if (const auto error = error_for_bytes(ranked, budget->bytes_per_patch))
        keep_least(least, {budget->bytes_per_patch, name, *error});
    found.push_back(least.value_or(LeastError{}));
  }
  return found;
}

ErrorDecay decay_of(const std::string& name, const RankedRows& rows) {
  std::vector<std::array<double, 2>> over_rank;
  std::vector<std::array<double, 2>> over_operator_error;
  over_rank.reserve(rows.size());
  over_operator_error.reserve(rows.size());
  for (const LowRankError* row : rows) {
    over_rank.push_back({static_cast<double>(row->k), row->errors->radiosity_mean});
    over_operator_error.push_back({row->operator_error, row->errors->radiosity_mean});
  }
  const double last = rows.back()->errors->radiosity_mean;
  return {name, fitted_exponent(over_rank), fitted_exponent(over_operator_error),
          last > 0 ? rows.back()->operator_error / last : 0};
}

/// SVD against every factorization of no larger rank, in T and in B.
void compare_with_svd(const std::map<std::string, RankedRows>& rows, const LowRankError& svd,
                      ProblemFindings& findings) {
  double least_in_T = std::numeric_limits<double>::infinity();
  double least_of_svd = svd.operator_error;
  bool beaten = false;
  bool beaten_by_others = false;
  for (const auto& [name, ranked] : rows) {
    const LowRankError* row = row_at(ranked, svd.k);
    if (row == nullptr || row->rank > svd.rank) continue;
    least_in_T = std::min(least_in_T, row->operator_error);
    if (name == area_svd) least_of_svd = std::min(least_of_svd, row->operator_error);
    const double error = row->errors->radiosity_mean;
    if (error * noticeable_gain > svd.errors->radiosity_mean || error <= 0) continue;
    beaten = true;
    beaten_by_others = beaten_by_others || name != area_svd;
    const double gain = svd.errors->radiosity_mean / error;
    if (gain <= findings.largest_gain) continue;
    findings.largest_gain = gain;
    findings.strongest_rival = {static_cast<double>(svd.k), name, error};
  }
  if (beaten) ++findings.svd_beaten_in_B;
  if (beaten_by_others) ++findings.svd_beaten_by_others;
  if (least_of_svd <= least_in_T) ++findings.svd_least_in_T;
}

void compare_with_bound(const ErrorStudy& study, const LowRankError& svd, ProblemFindings& findings) {
  const BestRankError* bound = study.bound(svd.problem, svd.rank);
  if (bound == nullptr || bound->errors.radiosity_rms <= 0) return;
  const double ratio = svd.errors->radiosity_rms / bound->errors.radiosity_rms;
  findings.svd_over_best_low =
      findings.svd_over_best_low == 0 ? ratio : std::min(findings.svd_over_best_low, ratio);
  findings.svd_over_best_high = std::max(findings.svd_over_best_high, ratio);
}

/// Ratios to the bounds for one kind of light alone.
std::array<double, 3> over_alone(const ErrorStudy& study, const RankedRows& rows) {
  std::array<double, 3> ratios{};
  const BestRankError* bound = rows.empty() ? nullptr : study.bound(rows.back()->problem, rows.back()->rank);
  if (bound == nullptr) return ratios;
  for (std::size_t kind = 0; kind < ratios.size(); ++kind) {
    const auto& error = rows.back()->errors->of_kind[kind];
    const auto& least = bound->alone[kind];
    if (error && least && *least > 0) ratios[kind] = *error / *least;
  }
  return ratios;
}

void compare_two_mesh(const LowRankError& two_mesh, const LowRankError& svd, ProblemFindings& findings) {
  for (std::size_t kind = 0; kind < findings.two_mesh_wins.size(); ++kind) {
    const auto& of_two_mesh = two_mesh.errors->of_kind[kind];
    const auto& of_svd = svd.errors->of_kind[kind];
    if (!of_two_mesh || !of_svd) continue;
    if (*of_two_mesh < *of_svd) ++findings.two_mesh_wins[kind];
    if (*of_svd > 0) findings.two_mesh_ratio[kind] = *of_two_mesh / *of_svd;
  }
}

ProblemFindings findings_of(const ErrorStudy& study, const ErrorStudyProblem& problem) {
  const std::map<std::string, RankedRows> rows = rows_of(study, problem);
  const auto rows_named = [&](const char* name) {
    const auto found = rows.find(name);
    return found == rows.end() ? RankedRows{} : found->second;
  };
  const RankedRows svd = rows_named(plain_svd);
  const RankedRows uniform = rows_named(uniform_two_mesh);
  const RankedRows adaptive = rows_named(adaptive_two_mesh);

  ProblemFindings findings;
  findings.problem = problem;
  findings.at_equal_rank = least_at_equal_rank(rows);
  findings.at_equal_bytes = least_at_equal_bytes(rows, svd);
  for (const auto& [name, ranked] : rows) findings.decays.push_back(decay_of(name, ranked));
  findings.svd_over_alone = over_alone(study, svd);
  findings.two_mesh_over_alone = over_alone(study, uniform);
  findings.ranks = static_cast<Index>(svd.size());
  for (const LowRankError* row : svd) {
    compare_with_svd(rows, *row, findings);
    compare_with_bound(study, *row, findings);
    if (const LowRankError* two_mesh = row_at(uniform, row->k)) compare_two_mesh(*two_mesh, *row, findings);
  }
  for (const LowRankError* row : uniform) {
    const LowRankError* rival = row_at(adaptive, row->k);
    if (rival != nullptr && rival->errors->radiosity_mean < row->errors->radiosity_mean)
      ++findings.adaptive_wins;
  }
  return findings;
}

}  // namespace

std::optional<double> fitted_exponent(const std::vector<std::array<double, 2>>& points) {
  double count = 0, x_sum = 0, y_sum = 0, xx_sum = 0, xy_sum = 0;
  for (const auto& [x, y] : points) {
    if (x <= 0 || y <= 0) continue;
    const double log_x = std::log(x);
    const double log_y = std::log(y);
    ++count;
    x_sum += log_x;
    y_sum += log_y;
    xx_sum += log_x * log_x;
    xy_sum += log_x * log_y;
  }
  const double spread = count * xx_sum - x_sum * x_sum;
  constexpr double least_spread = 1e-9;
  if (count < 2 || spread <= least_spread * count * count) return std::nullopt;
  return (count * xy_sum - x_sum * y_sum) / spread;
}

std::vector<ProblemFindings> find_in_study(const ErrorStudy& study) {
  std::vector<ProblemFindings> findings;
  for (const ErrorStudyProblem& problem : study.problems()) findings.push_back(findings_of(study, problem));
  return findings;
}

}  // namespace radiosity

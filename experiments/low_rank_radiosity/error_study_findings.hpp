#pragma once

#include "experiments/low_rank_radiosity/error_study.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// A power law y = c x^exponent fitted to points by least squares of logarithms; empty for fewer than two
/// different x. Points that are not positive are left out.
std::optional<double> fitted_exponent(const std::vector<std::array<double, 2>>& points);

/// An error counts as smaller than SVD's if that is at least so many times larger.
constexpr double noticeable_gain = 1.01;

/// Who has the least mean error in B for a given cost.
struct LeastError {
  double cost = 0;  ///< k, or bytes a patch
  std::string factorization;
  double error = 0;
};

/// How the error of one factorization falls on one problem.
struct ErrorDecay {
  std::string factorization;
  std::optional<double> over_rank;            ///< exponent of the mean error in B over k
  std::optional<double> over_operator_error;  ///< exponent of the mean error in B over the error in T
  double below_operator_error = 0;            ///< error in T / mean error in B at the largest k
};

/// What the measurements say of one problem.
struct ProblemFindings {
  ErrorStudyProblem problem;
  std::vector<LeastError> at_equal_rank;   ///< at every k
  std::vector<LeastError> at_equal_bytes;  ///< at the bytes of SVD of every k
  std::vector<ErrorDecay> decays;

  Index ranks = 0;                 ///< values of k at which SVD has an error
  Index svd_least_in_T = 0;        ///< values of k at which SVD, plain or of the area norm, is least in T
  Index svd_beaten_in_B = 0;       ///< noticeably, by a factorization of no larger rank
  Index svd_beaten_by_others = 0;  ///< the same, by one that is not SVD in the area norm
  LeastError strongest_rival;      ///< with the largest gain over SVD at equal rank; cost is k
  double largest_gain = 1;         ///< error in B of SVD / that of the rival
  double svd_over_best_low = 0;    ///< rms error in B of SVD over the best of rank k, over k
  double svd_over_best_high = 0;
  std::array<Index, 3> two_mesh_wins{};    ///< values of k at which uniform 2MSC has a smaller error than
                                           ///< SVD, of area, point and patch lights
  std::array<double, 3> two_mesh_ratio{};  ///< error of uniform 2MSC / SVD at the largest k, the same
  /// Mean error in B at the largest k over that of the best of the same rank for such lights alone: of SVD
  /// and of uniform 2MSC, by kind of light; 0 where there is none.
  std::array<double, 3> svd_over_alone{};
  std::array<double, 3> two_mesh_over_alone{};
  Index adaptive_wins = 0;  ///< values of k at which adaptive 2MSC beats uniform 2MSC
};

std::vector<ProblemFindings> find_in_study(const ErrorStudy& study);

/// The findings in sentences, and those of the spectra; every number in them is a measured one.
std::vector<std::string> answers(const ErrorStudy& study);

}  // namespace radiosity

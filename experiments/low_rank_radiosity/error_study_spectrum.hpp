#pragma once

#include "experiments/low_rank_radiosity/error_study.hpp"
#include "form_factors/form_factors.hpp"

#include <Eigen/Core>

#include <string>

namespace radiosity {

/// Eigenvalues above this stand on the shelf: between two patches that share a right-angled edge F is about
/// 0.2 however small they are.
constexpr double shelf_height = 0.1;

/// How many of some values, falling, are above the shelf's height.
Index count_above_shelf(const std::vector<double>& values);

/// Spectra of F and of its kernel K, with and without the pairs that share an edge.
SpectrumStudy study_spectrum(const std::string& scene, const FormFactors& form_factors,
                             const Eigen::MatrixXd& kernel);

}  // namespace radiosity

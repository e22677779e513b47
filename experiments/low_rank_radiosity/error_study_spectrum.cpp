#include "experiments/low_rank_radiosity/error_study_spectrum.hpp"

#include "experiments/low_rank_radiosity/adjacent_patches.hpp"
#include "factorizations/lapack.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace radiosity {
namespace {

std::vector<double> falling_magnitudes(const Eigen::VectorXd& values) {
  std::vector<double> magnitudes(static_cast<std::size_t>(values.size()));
  std::transform(values.begin(), values.end(), magnitudes.begin(), [](double v) { return std::abs(v); });
  std::sort(magnitudes.begin(), magnitudes.end(), std::greater<>());
  return magnitudes;
}

}  // namespace

Index count_above_shelf(const std::vector<double>& values) {
  return std::count_if(values.begin(), values.end(), [](double value) { return value > shelf_height; });
}

SpectrumStudy study_spectrum(const std::string& scene, const FormFactors& form_factors,
                             const Eigen::MatrixXd& kernel) {
  SpectrumStudy study;
  study.scene = scene;
  study.patches = kernel.rows();
  study.singular_values = falling_magnitudes(singular_value_decomposition(form_factors.matrix()).values);
  study.eigenvalues = falling_magnitudes(symmetric_eigenpairs(kernel).values);
  Eigen::MatrixXd distant = kernel;
  for (const auto& [i, j] : adjacent_patches(*form_factors.mesh)) {
    if (kernel(i, j) == 0) continue;
    ++study.adjacent_pairs;
    distant(i, j) = distant(j, i) = 0;
  }
  study.without_adjacent = falling_magnitudes(symmetric_eigenpairs(std::move(distant)).values);
  return study;
}

}  // namespace radiosity

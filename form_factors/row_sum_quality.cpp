#include "form_factors/row_sum_quality.hpp"

#include "foundation/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace radiosity {
namespace {

double largest_reciprocity_defect(const FormFactors& form_factors) {
  const Index n = form_factors.patch_count();
  const Eigen::VectorXd& area = form_factors.mesh->area;
  std::vector<double> largest(static_cast<std::size_t>(n), 0.0);
  parallel_for(largest.size(), [&](std::size_t row) {
    const auto i = static_cast<Index>(row);
    for (Index j = 0; j < i; ++j) {
      const double there = area[i] * form_factors(i, j), back = area[j] * form_factors(j, i);
      const double scale = std::max(there, back);
      if (scale > 0) largest[row] = std::max(largest[row], std::abs(there - back) / scale);
    }
  });
  return largest.empty() ? 0 : *std::max_element(largest.begin(), largest.end());
}

}  // namespace

void measure_row_sums(FormFactors& form_factors) {
  FormFactorQuality& quality = form_factors.quality;
  const Eigen::VectorXd sums = form_factors.row_sums();
  double low = 0, high = 0, squares = 0;
  Index live = 0;
  for (Index i = 0; i < sums.size(); ++i) {
    if (form_factors.exposed[i] <= 0) continue;
    low = live == 0 ? sums[i] : std::min(low, sums[i]);
    high = live == 0 ? sums[i] : std::max(high, sums[i]);
    squares += (sums[i] - form_factors.exposed[i]) * (sums[i] - form_factors.exposed[i]);
    ++live;
  }
  quality.row_sum_min = low;
  quality.row_sum_max = high;
  quality.row_sum_rms = live > 0 ? std::sqrt(squares / static_cast<double>(live)) : 0;
  // A symmetric kernel keeps one number for both directions.
  quality.reciprocity_max = form_factors.symmetric() ? 0 : largest_reciprocity_defect(form_factors);
}

}  // namespace radiosity

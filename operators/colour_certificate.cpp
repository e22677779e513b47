#include "operators/colour_certificate.hpp"

#include "foundation/parallel.hpp"
#include "operators/rounding_certificate.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace radiosity {
namespace {

/// Sums of |A - T|, of T and of A, each along rows, and down columns with the rows' areas.
struct DifferenceSums {
  Eigen::VectorXd error_rows, true_rows, own_rows;
  Eigen::VectorXd error_columns, own_columns;

  explicit DifferenceSums(Index n)
      : error_rows(Eigen::VectorXd::Zero(n)),
        true_rows(error_rows),
        own_rows(error_rows),
        error_columns(error_rows),
        own_columns(error_rows) {}
};

DifferenceSums sum_differences(const CompressedColours& compressed, const ColourMatrix& matrix, Index channel,
                               const Eigen::VectorXd& reflectance, const Eigen::VectorXd& inverse_colour,
                               const Eigen::VectorXd& area) {
  const Index n = compressed.size();
  DifferenceSums sums(n);
  const std::vector<Index>& order = compressed.order();
  std::vector<Eigen::VectorXd> error_columns(static_cast<std::size_t>(compressed.row_groups()));
  std::vector<Eigen::VectorXd> own_columns(error_columns.size());
  parallel_for(error_columns.size(), [&](std::size_t group) {
    const auto rows = compressed.decode_rows(channel, static_cast<Index>(group));
    error_columns[group] = own_columns[group] = Eigen::VectorXd::Zero(n);
    for (Index r = 0; r < rows.rows(); ++r) {
      const Index i = order[group * CompressedColours::rows_of_group + static_cast<std::size_t>(r)];
      for (Index c = 0; c < n; ++c) {
        const Index j = order[static_cast<std::size_t>(c)];
        const double weight = reflectance[i] * inverse_colour[j];
        const auto truth = static_cast<double>(matrix(i, j));
        const double error = weight * std::fabs(rows(r, c) - truth);
        sums.error_rows[i] += error;
        sums.true_rows[i] += weight * truth;
        sums.own_rows[i] += weight * rows(r, c);
        error_columns[group][j] += area[i] / area[j] * error;
        own_columns[group][j] += area[i] / area[j] * weight * rows(r, c);
      }
    }
  });
  for (std::size_t group = 0; group < error_columns.size(); ++group) {
    sums.error_columns += error_columns[group];
    sums.own_columns += own_columns[group];
  }
  return sums;
}

}  // namespace

Certificate colour_certificate(const CompressedColours& compressed, std::span<const ColourMatrix> matrices,
                               const Eigen::MatrixXd& reflectance, const Eigen::MatrixXd& colours,
                               const Eigen::VectorXd& area) {
  constexpr double slack = 1 + 1e-10;          // for rounding of the sums in double
  constexpr double rounded_entries = 0x1p-23;  // of M, which is in float here
  const double rounding = product_rounding<float>(compressed.size()) + rounded_entries;
  Certificate certificate{.spectral_radius_bound = 0, .operator_error = 0, .method = "proved"};
  if (compressed.size() == 0) return certificate;
  for (Index channel = 0; channel < compressed.channels(); ++channel) {
    const DifferenceSums sums =
        sum_differences(compressed, matrices[static_cast<std::size_t>(channel)], channel,
                        reflectance.col(channel), colours.col(channel).cwiseInverse(), area);
    const double error = std::sqrt(sums.error_rows.maxCoeff() * sums.error_columns.maxCoeff());
    const double own = std::sqrt(sums.own_rows.maxCoeff() * sums.own_columns.maxCoeff());
    const Eigen::ArrayXd root_area = area.array().sqrt();
    const double norm = (root_area * sums.true_rows.array()).matrix().norm() / root_area.matrix().norm();
    certificate.spectral_radius_bound =
        std::max(*certificate.spectral_radius_bound, slack * sums.own_rows.maxCoeff());
    if (norm > 0)
      certificate.operator_error =
          std::max(*certificate.operator_error, slack * (error + rounding * (own + norm)) / norm);
  }
  return certificate;
}

}  // namespace radiosity

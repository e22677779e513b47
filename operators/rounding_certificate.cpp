#include "operators/rounding_certificate.hpp"

#include "kernels/stored_number.hpp"

#include <algorithm>
#include <type_traits>

namespace radiosity {
namespace {

constexpr double u = unit_roundoff<double>();

/// Double-precision steps of any product with n columns: n multiplications and additions, chunks, both
/// diagonals.
double double_steps(Index n) {
  return 2 * (static_cast<double>(n) + 8) * u;
}

}  // namespace

template <typename Scalar>
double product_rounding(Index n) {
  if (std::is_same_v<Scalar, double>) return double_steps(n);
  // X is rounded once and at most 64 + 1 float32 roundings follow within a tile.
  return 1.01 * (unit_roundoff<Scalar>() + 66 * unit_roundoff<float>() + double_steps(n));
}

template double product_rounding<double>(Index);
template double product_rounding<float>(Index);
template double product_rounding<Half>(Index);

Certificate rounding_certificate(const Eigen::VectorXd& row_sums, bool non_negative,
                                 const Eigen::MatrixXd& reflectance, const Eigen::VectorXd& root_area,
                                 const RoundingError& error) {
  Certificate certificate;
  certificate.method = "proved";
  double radius = 0;
  double operator_error = 0;
  for (Index channel = 0; channel < reflectance.cols() && row_sums.size() > 0; ++channel) {
    const Eigen::ArrayXd sums = reflectance.col(channel).array() * row_sums.array();
    radius = std::max(radius, sums.maxCoeff());
    const double norm = (root_area.array() * sums).matrix().norm() / root_area.norm();
    if (norm == 0) continue;  // T = 0 in this channel, and so is A
    operator_error = std::max(operator_error,
                              error.relative + error.absolute * reflectance.col(channel).maxCoeff() / norm);
  }
  certificate.spectral_radius_bound = radius * (1 + double_steps(row_sums.size()));
  if (non_negative) certificate.operator_error = operator_error;
  return certificate;
}

}  // namespace radiosity

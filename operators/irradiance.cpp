#include "operators/irradiance.hpp"

#include "foundation/error.hpp"
#include "kernels/products.hpp"
#include "operators/low_rank_operator.hpp"

namespace radiosity {

Field irradiance(const FormFactors& form_factors, const LinearOperator& transport, const Field& radiosity) {
  Field result(radiosity.rows(), radiosity.cols());
  if (form_factors.unsymmetric) {
    multiply(*form_factors.unsymmetric, radiosity, result);
    return result;
  }
  if (form_factors.kernel) {
    const Eigen::ArrayXd root_area = form_factors.mesh->area.array().sqrt();
    const Field scaled = radiosity.array().colwise() * root_area;
    multiply(*form_factors.kernel, scaled, result);
    return result.array().colwise() / root_area;
  }
  const auto* factors = dynamic_cast<const LowRankFactors*>(&transport);
  if (factors == nullptr) fail("{} has no F to compute the irradiance with", transport.describe());
  Field coefficients(factors->rank(), radiosity.cols());
  factors->multiply_right_transposed(radiosity, coefficients);
  factors->multiply_left(coefficients, result);
  return result;
}

}  // namespace radiosity

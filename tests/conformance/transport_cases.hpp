#pragma once

#include "form_factors/form_factors.hpp"
#include "operators/operator_checks.hpp"

#include <string>
#include <vector>

namespace radiosity {

/// Form factors made by hand and T as it should be.
struct TransportCase {
  std::string name;
  FormFactors form_factors;
  OperatorReference reference;
  Eigen::VectorXd root_area;
};

/// F from a symmetric kernel, n x n; tiles that are zero are not kept.
FormFactors symmetric_form_factors(const Eigen::MatrixXd& kernel, const Eigen::VectorXd& area,
                                   const Eigen::MatrixXd& reflectance);

/// F as a full matrix without reciprocity, as gathering gives it.
FormFactors unsymmetric_form_factors(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& area,
                                     const Eigen::MatrixXd& reflectance);

/// A non-negative symmetric kernel of norm below 1 with a zero diagonal (planar patches) and about a third of
/// zeros.
Eigen::MatrixXd random_kernel(Index n, std::uint64_t seed);

/// The data that every operator meets at size n: unequal areas (1e-6 to 1e6), grey and RGB, an isolated
/// patch, black patches, F = 0, an unsymmetric F; and for n = 6 the closed unit cube.
std::vector<TransportCase> transport_cases(Index n);

/// Sets what an operator with this storage is allowed: u and what entries lose that underflow.
void allow_storage_error(TransportCase& data, double unit_roundoff);

}  // namespace radiosity

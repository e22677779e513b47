#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace radiosity::testing {

/// A matrix whose singular values are known, or empty where they are not (Kahan's).
struct HardMatrix {
  std::string name;
  Eigen::MatrixXd matrix;
  Eigen::VectorXd values;  ///< falling
};

/// n values from 1 down to 1 / condition, each the same part of the one before.
Eigen::VectorXd geometric_values(Eigen::Index n, double condition);

/// rows x columns with these singular values and random singular vectors.
Eigen::MatrixXd matrix_with_values(Eigen::Index rows, Eigen::Index columns, const Eigen::VectorXd& values,
                                   std::uint64_t seed);

/// Hard case F1: geometric, arithmetic, log-random and step spectra, condition 2, 1e8 and 1e15, Kahan's
/// matrix, zero, the identity, rank deficient, scaled by 1e150 and 1e-150; square, tall and wide.
std::vector<HardMatrix> hard_matrices(std::uint64_t seed);

}  // namespace radiosity::testing

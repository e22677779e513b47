#pragma once

#include "kernels/csr_matrix.hpp"

#include <Eigen/Core>

namespace radiosity {

/// The exact part of document 000, section 3.5, for one channel: of each row of a non-negative m x n matrix
/// the round(fraction n) largest entries (halves up), of equal ones those of lower columns. Zeros are never
/// taken, so that a row may have fewer. Throws UsageError unless 0 <= fraction <= 1, and Error for entries
/// that are negative, infinite or NaN.
CsrMatrix<float> largest_of_rows(
    const Eigen::Ref<const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>& matrix,
    double fraction);

}  // namespace radiosity

#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>

namespace radiosity {

/// The codes of one channel of a matrix, n x m, by rows.
using CodeMatrix = Eigen::Matrix<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Squared Euclidean distances between rows, n x n, with the channels' columns beside each other: the measure
/// by which document 000, section 3.5, orders rows (of transposed matrices: columns). Whole numbers without
/// any rounding, so that neither threads nor the processor change them. Takes n^2 (m / 2 multiplications and
/// 12 bytes). Throws UsageError for channels of different numbers of rows.
Eigen::MatrixXd squared_row_distances(std::span<const CodeMatrix> channels);

}  // namespace radiosity

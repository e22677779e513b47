#pragma once

#include <Eigen/Core>

#include <filesystem>

namespace radiosity {

/// Writes a matrix as NumPy's .npy version 1.0, float64, C order (rows x cols). Appears whole or not at all.
void write_npy(const std::filesystem::path& file, const Eigen::Ref<const Eigen::MatrixXd>& matrix);

/// Reads a .npy of one or two dimensions (one: a column), little-endian float32 or float64, C or Fortran
/// order. Throws Error for anything else, for a truncated file and for NaN or infinity, naming file and
/// element.
Eigen::MatrixXd read_npy(const std::filesystem::path& file);

}  // namespace radiosity

#pragma once

#include "compression/compressed_colours.hpp"
#include "kernels/row_groups.hpp"
#include "kernels/row_major_matrix.hpp"
#include "kernels/symmetric_tiles.hpp"

#include <variant>
#include <vector>

namespace radiosity {

/// A matrix as an operator stores it, for who copies it elsewhere; it lives as long as the operator.
using StoredMatrix =
    std::variant<const SymmetricTiles<double>*, const SymmetricTiles<float>*, const SymmetricTiles<Half>*,
                 const RowMajorMatrix<double>*, const RowMajorMatrix<float>*, const RowMajorMatrix<Half>*,
                 const RowGroups<double>*, const RowGroups<float>*>;

/// The side interface of operators that multiply with one matrix between their diagonals: the kernel K of a
/// KernelOperator, or F of a MatrixOperator.
class HasStoredMatrix {
 public:
  virtual ~HasStoredMatrix() = default;
  virtual StoredMatrix stored() const = 0;
};

/// The side interface of ColourOperators that keep a full matrix for each distinct reflectance, in the order
/// of DistinctReflectances.
class HasStoredColours {
 public:
  virtual ~HasStoredColours() = default;
  virtual std::vector<StoredMatrix> stored_colours() const = 0;
};

/// ... and of those that keep compressed ones.
class HasCompressedColours {
 public:
  virtual ~HasCompressedColours() = default;
  virtual const CompressedColours& compressed_colours() const = 0;
  /// Of the patches, for certificates of other placements.
  virtual const Eigen::VectorXd& area() const = 0;
};

/// The side interface of KernelOperators whose kernel is in quantized tiles.
class HasCompressedKernel {
 public:
  virtual ~HasCompressedKernel() = default;
  virtual const QuantizedTiles& compressed_kernel() const = 0;
  /// The patch at each place of its rows and columns; empty: patches in their own order.
  virtual const std::vector<Index>& kernel_order() const = 0;
};

/// The side interface of global operators that keep G - I by compressed rows for each distinct reflectance,
/// in the order of DistinctReflectances.
class HasStoredSeries {
 public:
  virtual ~HasStoredSeries() = default;
  virtual std::vector<const RowGroups<float>*> stored_series() const = 0;
  /// rho, n x channels.
  virtual const Eigen::MatrixXd& reflectance() const = 0;
};

}  // namespace radiosity

#pragma once

#include "kernels/quantized_tiles.hpp"
#include "kernels/symmetric_tiles.hpp"

namespace radiosity {

struct QuantizeOptions {
  int bits = 4;           ///< a code: 2, 4 or 8
  int block = 32;         ///< consecutive entries of a row with one step: 16, 32 or 64
  double exact = 0.01;    ///< at most this fraction of all entries is kept apart in float32, 0 to 1
  bool diffusion = true;  ///< what rounding adds to an entry is taken from its neighbours
};

/// A non-negative symmetric matrix in codes of a few bits. Zeros stay zero, and nothing becomes negative.
///
/// - Exact entries are chosen where they save most: taking the k largest entries of a block apart lowers its
///   step to that of the next one, and with it the sum of the squared errors; entries are taken in the order
///   of what they save (of each block's upper convex hull), over the whole matrix. A few large entries among
///   small ones go first, a block of equal entries never.
/// - A step is the largest remaining entry of a block over the largest code, rounded up to binary16.
/// - Diffusion (Floyd and Steinberg 1976, over rows and columns of a tile, there and back) moves the rounding
///   error of entry (i, j) times weight_i weight_j to entries not yet rounded. With K_ij = A_i F_ij /
///   sqrt(A_i A_j) and weight = A^{1/2} that is energy: sums over neighbouring patches on either side keep
///   it.
///
/// weight: n, > 0. Throws UsageError for options out of range and Error for entries that are negative,
/// infinite or NaN. Deterministic.
QuantizedTiles quantize(const SymmetricTiles<double>& K, const Eigen::VectorXd& weight,
                        const QuantizeOptions& options);

}  // namespace radiosity

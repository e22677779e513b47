#pragma once

#include "kernels/quantized_tiles.hpp"
#include "kernels/symmetric_tiles.hpp"

namespace radiosity {

/// The largest entries of a non-negative symmetric matrix, at most `fraction` (0 to 1) of all n^2, in
/// float32; the others are dropped. In the area norm no other choice of as many entries is nearer to K
/// (Frobenius). Throws UsageError for other fractions and Error for entries that are negative, infinite or
/// NaN.
QuantizedTiles keep_largest(const SymmetricTiles<double>& K, double fraction);

}  // namespace radiosity

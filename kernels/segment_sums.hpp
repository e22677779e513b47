#pragma once

#include "kernels/products.hpp"
#include "kernels/segments.hpp"

namespace radiosity {

/// How the rows of a field lie: as the rows of V, or at the positions to which V's rows were sorted.
enum class RowOrder { scene, sorted };

/// C = V' X, k x c from n x c: document 004, Eq. 7. C is written, never read, and does not alias X.
/// Componentwise error <= 40 u |V'| |X| with u = 2^-53, however long the segments: runs of 256 numbers are
/// added in 16 lanes, the runs with compensation. The result is the same, bit for bit, for any number of
/// threads, and that of a column does not depend on the other columns. Throws UsageError where shapes do not
/// fit.
void segment_sums(const Segments& V, const ConstFieldRef& X, FieldRef C, RowOrder rows = RowOrder::scene);

/// Y = V C, n x c from k x c: every row gets its weight times its segment's number. Same promises.
void spread_segments(const Segments& V, const ConstFieldRef& C, FieldRef Y, RowOrder rows = RowOrder::scene);

}  // namespace radiosity

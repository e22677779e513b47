#pragma once

#include "compression/row_distances.hpp"
#include "kernels/csr_matrix.hpp"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace radiosity {

/// One channel of a non-negative n x n matrix, by rows.
using ColourMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Which number a code is nearest to, in [0, 255], from a number's part of the largest, in [0, 1].
using CodeOfPart = std::function<double(double part)>;

/// A channel split as document 000, section 3.5, has it: the entries that are kept exactly, and codes between
/// 0 and 255 for the rest.
struct CodedChannel {
  CodeMatrix code;         ///< whole numbers; 0 where an entry is 0
  CsrMatrix<float> exact;  ///< the largest of each row
  double largest = 0;      ///< the number that code 255 stands for: the largest entry that is not exact
};

/// Codes of a matrix without its `exact` part. Entries of the exact part get code 0, as in the document, or,
/// with `fill`, the code nearest to their own number: in a block of neighbours it does no harm, and 0 would.
CodedChannel code_channel(const ColourMatrix& matrix, CsrMatrix<float> exact, const CodeOfPart& code,
                          bool fill);

/// The largest entry of a matrix that is not in its exact part; 0 if there is none.
double largest_of_rest(const ColourMatrix& matrix, const CsrMatrix<float>& exact);

/// The natural logarithms that the rest of a matrix spans: what lies further below the largest makes up at
/// most `share` of its sum.
double spanned_range(const ColourMatrix& matrix, const CsrMatrix<float>& exact, double share);

}  // namespace radiosity

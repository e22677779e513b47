#pragma once

#include "kernels/csr_matrix.hpp"

#include <optional>

namespace radiosity {

/// A sparse matrix by block compressed rows, in blocks of four rows and one column: row i of it stands for
/// the rows 4 i ... 4 i + 3 (zeros beyond the last) and has one column for each in which one of them has an
/// entry, rising, and four values for each column. Empty where blocks would be less than half full on
/// average: then single rows take less memory and fewer reads. Columns rise within the rows of `matrix`.
template <typename Scalar>
std::optional<CsrMatrix<Scalar>> row_fours(const CsrMatrix<Scalar>& matrix);

}  // namespace radiosity

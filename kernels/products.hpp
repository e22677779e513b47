#pragma once

#include "kernels/colour_texture.hpp"
#include "kernels/csr_matrix.hpp"
#include "kernels/instruction_set.hpp"
#include "kernels/quantized_tiles.hpp"
#include "kernels/row_groups.hpp"
#include "kernels/row_major_matrix.hpp"
#include "kernels/symmetric_tiles.hpp"
#include "kernels/tall_matrix.hpp"

namespace radiosity {

using ConstFieldRef = Eigen::Ref<const Eigen::MatrixXd>;
using FieldRef = Eigen::Ref<Eigen::MatrixXd>;

/// Y = K X for X and Y of n x c, any c >= 0; Y is written, never read, and does not alias X.
/// float and Half tiles multiply in float32 within four tiles and add up in double: componentwise error <= 2
/// n u |K| |X| with u the unit roundoff of the stored type, barring underflow (X is scaled per column and 256
/// rows, so only what is 2^-126 of the largest of them can underflow). The result is the same, bit for bit,
/// for any number of threads, and that of a column does not depend on the other columns. Throws UsageError
/// where shapes do not fit.
void multiply(const SymmetricTiles<double>& K, const ConstFieldRef& X, FieldRef Y,
              InstructionSet instructions = best_instruction_set());
void multiply(const SymmetricTiles<float>& K, const ConstFieldRef& X, FieldRef Y,
              InstructionSet instructions = best_instruction_set());
void multiply(const SymmetricTiles<Half>& K, const ConstFieldRef& X, FieldRef Y,
              InstructionSet instructions = best_instruction_set());

/// |Y - K X| <= this |K| |X|, component by component, for double tiles: within four tiles a number passes at
/// most 128 additions in its lane (of two numbers at least) and two across lanes, then one for each four
/// tiles or, down columns, 64 and one for each tile, and 64 for the chunks of work. Twice that many u.
constexpr double tiled_product_error(Index n) {
  return 2 * (200 + static_cast<double>(n) / 64) * 0x1p-53;
}

/// The same for a quantized matrix, with u of float: each tile is decoded into the first cache, where it
/// serves all columns. A symmetric one is its own transpose.
void multiply(const QuantizedTiles& K, const ConstFieldRef& X, FieldRef Y,
              InstructionSet instructions = best_instruction_set());
void multiply_transposed(const QuantizedTiles& M, const ConstFieldRef& X, FieldRef Y,
                         InstructionSet instructions = best_instruction_set());

/// Column j of Y = M_c X and Y = M_c' X for the matrices of a texture, c = j modulo their number; X has a
/// multiple of so many columns. Same promises, with u of float, relative to the numbers that texel() gives
/// (X is scaled per column, so that only what is 2^-100 of the largest of them can underflow).
void multiply(const ColourTexture& M, const ConstFieldRef& X, FieldRef Y,
              InstructionSet instructions = best_instruction_set());
void multiply_transposed(const ColourTexture& M, const ConstFieldRef& X, FieldRef Y,
                         InstructionSet instructions = best_instruction_set());

/// Y = M X and Y = M' X for a full matrix stored by rows, m x n. Same promises.
void multiply(const RowMajorMatrix<double>& M, const ConstFieldRef& X, FieldRef Y,
              InstructionSet instructions = best_instruction_set());
void multiply(const RowMajorMatrix<float>& M, const ConstFieldRef& X, FieldRef Y,
              InstructionSet instructions = best_instruction_set());
void multiply(const RowMajorMatrix<Half>& M, const ConstFieldRef& X, FieldRef Y,
              InstructionSet instructions = best_instruction_set());
void multiply_transposed(const RowMajorMatrix<double>& M, const ConstFieldRef& X, FieldRef Y,
                         InstructionSet instructions = best_instruction_set());
void multiply_transposed(const RowMajorMatrix<float>& M, const ConstFieldRef& X, FieldRef Y,
                         InstructionSet instructions = best_instruction_set());
void multiply_transposed(const RowMajorMatrix<Half>& M, const ConstFieldRef& X, FieldRef Y,
                         InstructionSet instructions = best_instruction_set());

/// Y = M C (n x c from k x c) and C = M' X (k x c from n x c) for an n x k matrix with few columns. Same
/// promises.
void multiply(const TallMatrix<double>& M, const ConstFieldRef& C, FieldRef Y,
              InstructionSet instructions = best_instruction_set());
void multiply(const TallMatrix<float>& M, const ConstFieldRef& C, FieldRef Y,
              InstructionSet instructions = best_instruction_set());
/// Rows 64 first_panel ... of M C, as many as Y has: a multiple of 64, or all that are left.
void multiply_panels(const TallMatrix<double>& M, Index first_panel, const ConstFieldRef& C, FieldRef Y,
                     InstructionSet instructions = best_instruction_set());
void multiply_panels(const TallMatrix<float>& M, Index first_panel, const ConstFieldRef& C, FieldRef Y,
                     InstructionSet instructions = best_instruction_set());
void multiply_transposed(const TallMatrix<double>& M, const ConstFieldRef& X, FieldRef C,
                         InstructionSet instructions = best_instruction_set());
void multiply_transposed(const TallMatrix<float>& M, const ConstFieldRef& X, FieldRef C,
                         InstructionSet instructions = best_instruction_set());

/// Y = M X and Y = M' X for a sparse matrix, in double. Same promises.
void multiply(const RowGroups<double>& M, const ConstFieldRef& X, FieldRef Y,
              InstructionSet instructions = best_instruction_set());
void multiply(const RowGroups<float>& M, const ConstFieldRef& X, FieldRef Y,
              InstructionSet instructions = best_instruction_set());
void multiply_transposed(const RowGroups<double>& M, const ConstFieldRef& X, FieldRef Y,
                         InstructionSet instructions = best_instruction_set());
void multiply_transposed(const RowGroups<float>& M, const ConstFieldRef& X, FieldRef Y,
                         InstructionSet instructions = best_instruction_set());
/// The same without vector instructions, for matrices whose rows share few columns: gathering X is the limit.
void multiply(const CsrMatrix<double>& M, const ConstFieldRef& X, FieldRef Y);
void multiply(const CsrMatrix<float>& M, const ConstFieldRef& X, FieldRef Y);
void multiply_transposed(const CsrMatrix<double>& M, const ConstFieldRef& X, FieldRef Y);
void multiply_transposed(const CsrMatrix<float>& M, const ConstFieldRef& X, FieldRef Y);

}  // namespace radiosity

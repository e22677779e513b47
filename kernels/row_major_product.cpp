#include "foundation/parallel.hpp"
#include "kernels/blocked_field.hpp"
#include "kernels/partial_sums.hpp"
#include "kernels/product_shapes.hpp"
#include "kernels/products.hpp"
#include "kernels/tile_products.hpp"

#include <algorithm>
#include <array>

namespace radiosity {
namespace {

/// Rows that are read side by side: as many as the memory system follows as separate streams.
constexpr Index panel_rows = 16;

template <typename Scalar>
using Blocked = BlockedField<typename Multiplier<Scalar>::Type>;

template <typename Scalar>
TileTask<Scalar> panel_task(const RowMajorMatrix<Scalar>& M, Index first_row, Index column_block) {
  TileTask<Scalar> task;
  task.entries = M.row(first_row) + 64 * column_block;
  task.stride = M.stride();
  task.rows = static_cast<int>(std::min(panel_rows, M.rows() - first_row));
  return task;
}

template <typename Scalar>
void multiply_panel(const RowMajorMatrix<Scalar>& M, Index first_row, const Blocked<Scalar>& X,
                    Index first_column, const TileProducts<Scalar>& products, FieldRef Y) {
  for (Index c = 0; c < X.columns(); c += products.most_columns) {
    const Index columns = std::min<Index>(products.most_columns, X.columns() - c);
    alignas(64) std::array<double, 64 * TileProducts<Scalar>::most_columns> sums{};
    alignas(64) std::array<typename Multiplier<Scalar>::Type, row_lanes_size<Scalar>> lanes;
    for (Index b = 0; b < X.blocks(); ++b) {
      TileTask<Scalar> task = panel_task(M, first_row, b);
      task.row_lanes = lanes.data();
      task.first = b % tiles_together == 0;
      task.last = (b + 1) % tiles_together == 0 || b + 1 == X.blocks();
      task.x_columns = X.block(b) + 64 * c;
      task.x_columns_scale = X.scale(b) + c;
      task.y_rows = sums.data();
      products.to_rows[static_cast<std::size_t>(columns - 1)](task);
    }
    for (Index k = 0; k < columns; ++k)
      for (Index r = 0; r < std::min(panel_rows, M.rows() - first_row); ++r)
        Y(first_row + r, first_column + c + k) = M.scale() * sums[static_cast<std::size_t>(64 * k + r)];
  }
}

template <typename Scalar>
void multiply_full(const RowMajorMatrix<Scalar>& M, const ConstFieldRef& X, FieldRef Y,
                   InstructionSet instructions) {
  check_product_shapes(M.rows(), M.cols(), X, Y);
  const TileProducts<Scalar> products = tile_products<Scalar>(instructions);
  const Index panels = (M.rows() + panel_rows - 1) / panel_rows;
  for (Index first = 0; first < X.cols(); first += columns_at_once) {
    const Blocked<Scalar> blocked(X, first, std::min(columns_at_once, X.cols() - first));
    parallel_for(static_cast<std::size_t>(panels), [&](std::size_t panel) {
      multiply_panel(M, static_cast<Index>(panel) * panel_rows, blocked, first, products, Y);
    });
  }
}

/// Adds what the rows first_row ... last_row - 1 contribute to M' X to the sums of a chunk.
template <typename Scalar>
void multiply_rows_transposed(const RowMajorMatrix<Scalar>& M, Index first_row, Index last_row,
                              const Blocked<Scalar>& X, const TileProducts<Scalar>& products, Index chunk,
                              PartialSums& sums) {
  sums.start(chunk);
  for (Index row = first_row; row < last_row; row += panel_rows)
    for (Index b = 0; b < M.stride() / 64; ++b)
      for (Index c = 0; c < X.columns(); c += products.most_columns) {
        const Index columns = std::min<Index>(products.most_columns, X.columns() - c);
        TileTask<Scalar> task = panel_task(M, row, b);
        task.x_rows = X.block(row / 64) + 64 * c + row % 64;
        task.x_rows_scale = X.scale(row / 64) + c;
        task.y_columns = sums.block(chunk, b) + 64 * c;
        products.to_columns[static_cast<std::size_t>(columns - 1)](task);
      }
}

template <typename Scalar>
void multiply_full_transposed(const RowMajorMatrix<Scalar>& M, const ConstFieldRef& X, FieldRef Y,
                              InstructionSet instructions) {
  check_product_shapes(M.cols(), M.rows(), X, Y);
  const TileProducts<Scalar> products = tile_products<Scalar>(instructions);
  const Index panels = (M.rows() + panel_rows - 1) / panel_rows;
  const Index chunks = std::clamp<Index>(panels / 16, 1, 64);
  for (Index first = 0; first < X.cols(); first += columns_at_once) {
    const Index columns = std::min(columns_at_once, X.cols() - first);
    const Blocked<Scalar> blocked(X, first, columns);
    PartialSums sums(M.stride() / 64, columns, std::vector<Index>(static_cast<std::size_t>(chunks), 0));
    parallel_for(static_cast<std::size_t>(chunks), [&](std::size_t index) {
      const auto chunk = static_cast<Index>(index);
      const Index begin = panels * chunk / chunks * panel_rows;
      const Index end = std::min(panels * (chunk + 1) / chunks * panel_rows, M.rows());
      multiply_rows_transposed(M, begin, end, blocked, products, chunk, sums);
    });
    sums.finish(M.scale(), first, Y);
  }
}

}  // namespace

void multiply(const RowMajorMatrix<double>& M, const ConstFieldRef& X, FieldRef Y,
              InstructionSet instructions) {
  multiply_full(M, X, Y, instructions);
}
void multiply(const RowMajorMatrix<float>& M, const ConstFieldRef& X, FieldRef Y,
              InstructionSet instructions) {
  multiply_full(M, X, Y, instructions);
}
void multiply(const RowMajorMatrix<Half>& M, const ConstFieldRef& X, FieldRef Y,
              InstructionSet instructions) {
  multiply_full(M, X, Y, instructions);
}
void multiply_transposed(const RowMajorMatrix<double>& M, const ConstFieldRef& X, FieldRef Y,
                         InstructionSet instructions) {
  multiply_full_transposed(M, X, Y, instructions);
}
void multiply_transposed(const RowMajorMatrix<float>& M, const ConstFieldRef& X, FieldRef Y,
                         InstructionSet instructions) {
  multiply_full_transposed(M, X, Y, instructions);
}
void multiply_transposed(const RowMajorMatrix<Half>& M, const ConstFieldRef& X, FieldRef Y,
                         InstructionSet instructions) {
  multiply_full_transposed(M, X, Y, instructions);
}

}  // namespace radiosity

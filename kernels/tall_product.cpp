#include "foundation/parallel.hpp"
#include "kernels/blocked_field.hpp"
#include "kernels/partial_sums.hpp"
#include "kernels/product_shapes.hpp"
#include "kernels/products.hpp"
#include "kernels/tile_products.hpp"

#include <algorithm>
#include <array>

// A panel of 64 rows, stored by columns, is 64 columns of the transposed matrix: any run of panel columns is
// a task of the tiles' inner loops.

namespace radiosity {
namespace {

/// Entries that take a thread long enough, some 20 us, to be worth waking it.
constexpr Index entries_of_a_task = 65536;

/// Panels whose products with one column may be added up in single precision.
constexpr Index run_panels = tiles_together;
/// Panels whose rows of X are converted together: a few runs.
constexpr Index converted_panels = 4 * run_panels;

template <typename Scalar>
using TallField = BlockedField<typename Multiplier<Scalar>::Type>;

/// Columns of a panel that U C takes at once: a block of C.
constexpr Index columns_to_spread = 64;
/// Columns of a panel that V' X takes at once. With 16 the tiles of a run, what is fetched ahead and the sums
/// apart by lane stay in a first cache of 32 KB together; with 64, three columns of X were 5 to 8 % slower.
constexpr Index columns_to_sum = 16;

/// The panel's columns first ... first + count - 1, as far as there are any.
template <typename Scalar>
TileTask<Scalar> tall_task(const TallMatrix<Scalar>& M, Index panel, Index first, Index count) {
  TileTask<Scalar> task;
  task.entries = M.panel(panel) + first * 64;
  task.rows = static_cast<int>(std::min(count, M.columns() - first));
  return task;
}

/// Y(row ..., first_column ...) = the panel times C.
template <typename Scalar>
void multiply_tall_panel(const TallMatrix<Scalar>& M, Index panel, const TallField<Scalar>& C,
                         const TileProducts<Scalar>& products, Index first_column, Index row, FieldRef Y) {
  const Index rows = std::min<Index>(64, M.rows() - 64 * panel);
  for (Index c = 0; c < C.columns(); c += products.most_columns) {
    const Index columns = std::min<Index>(products.most_columns, C.columns() - c);
    alignas(64) std::array<double, 64 * TileProducts<Scalar>::most_columns> sums{};
    for (Index tile = 0; tile < C.blocks(); ++tile) {
      TileTask<Scalar> task = tall_task(M, panel, tile * columns_to_spread, columns_to_spread);
      task.prefetch = reinterpret_cast<const char*>(task.entries + 64 * columns_to_spread);
      task.x_rows = C.block(tile) + 64 * c;
      task.x_rows_scale = C.scale(tile) + c;
      task.y_columns = sums.data();
      products.to_columns[static_cast<std::size_t>(columns - 1)](task);
    }
    for (Index j = 0; j < columns; ++j) {
      double* y = Y.col(first_column + c + j).data() + row;
      for (Index i = 0; i < rows; ++i) y[i] = M.scale() * sums[static_cast<std::size_t>(64 * j + i)];
    }
  }
}

template <typename Scalar>
void multiply_tall(const TallMatrix<Scalar>& M, Index first_panel, Index rows, const ConstFieldRef& C,
                   FieldRef Y, InstructionSet instructions) {
  check_product_shapes(rows, M.columns(), C, Y);
  const TileProducts<Scalar> products = tile_products<Scalar>(instructions);
  const Index grain = std::max<Index>(entries_of_a_task / (64 * std::max<Index>(M.columns(), 16)), 1);
  for (Index first = 0; first < C.cols(); first += columns_at_once) {
    const TallField<Scalar> blocked(C, first, std::min(columns_at_once, C.cols() - first));
    parallel_for(
        static_cast<std::size_t>((rows + 63) / 64),
        [&](std::size_t index) {
          const auto panel = static_cast<Index>(index);
          multiply_tall_panel(M, first_panel + panel, blocked, products, first, 64 * panel, Y);
        },
        static_cast<std::size_t>(grain));
  }
}

/// Adds what panels begin ... end - 1, a run, contribute to M' X to the sums of a chunk; X is the field from
/// row 64 first_panel.
template <typename Scalar>
void multiply_run_transposed(const TallMatrix<Scalar>& M, Index begin, Index end, const TallField<Scalar>& X,
                             Index first_panel, const TileProducts<Scalar>& products, Index chunk,
                             PartialSums& sums) {
  alignas(64) std::array<typename Multiplier<Scalar>::Type, row_lanes_size<Scalar>> lanes;
  for (Index p = 0; p < M.columns(); p += columns_to_sum)
    for (Index c = 0; c < X.columns(); c += products.most_columns) {
      const Index columns = std::min<Index>(products.most_columns, X.columns() - c);
      for (Index panel = begin; panel < end; ++panel) {
        TileTask<Scalar> task = tall_task(M, panel, p, columns_to_sum);
        const Scalar* next =
            panel + 1 < end ? M.panel(panel + 1) + p * 64 : M.panel(begin) + (p + columns_to_sum) * 64;
        task.prefetch = reinterpret_cast<const char*>(next);
        task.row_lanes = lanes.data();
        task.first = panel == begin;
        task.last = panel + 1 == end;
        task.x_columns = X.block(panel - first_panel) + 64 * c;
        task.x_columns_scale = X.scale(panel - first_panel) + c;
        task.y_rows = sums.block(chunk, p / 64) + 64 * c + p % 64;
        products.to_rows[static_cast<std::size_t>(columns - 1)](task);
      }
    }
}

/// Adds what runs begin ... end - 1 contribute to M' X to the sums of a chunk.
template <typename Scalar>
void multiply_chunk_transposed(const TallMatrix<Scalar>& M, Index begin, Index end, const ConstFieldRef& X,
                               Index first_column, Index columns, const TileProducts<Scalar>& products,
                               Index chunk, PartialSums& sums) {
  sums.start(chunk);
  const Index last_panel = std::min(end * run_panels, M.panels());
  // A few runs of X at a time are converted right before their use and never leave the cache.
  for (Index first = begin * run_panels; first < last_panel; first += converted_panels) {
    const Index last = std::min(first + converted_panels, last_panel);
    const Index rows = std::min(64 * last, M.rows()) - 64 * first;
    const TallField<Scalar> field(X.middleRows(64 * first, rows), first_column, columns);
    for (Index panel = first; panel < last; panel += run_panels)
      multiply_run_transposed(M, panel, std::min(panel + run_panels, last), field, first, products, chunk,
                              sums);
  }
}

template <typename Scalar>
void multiply_tall_transposed(const TallMatrix<Scalar>& M, const ConstFieldRef& X, FieldRef C,
                              InstructionSet instructions) {
  check_product_shapes(M.columns(), M.rows(), X, C);
  const TileProducts<Scalar> products = tile_products<Scalar>(instructions);
  const Index runs = (M.panels() + run_panels - 1) / run_panels;
  const Index chunks = std::clamp<Index>(std::min(runs, M.rows() * M.columns() / entries_of_a_task), 1, 64);
  for (Index first = 0; first < X.cols(); first += columns_at_once) {
    const Index columns = std::min(columns_at_once, X.cols() - first);
    PartialSums sums((M.columns() + 63) / 64, columns,
                     std::vector<Index>(static_cast<std::size_t>(chunks), 0));
    parallel_for(static_cast<std::size_t>(chunks), [&](std::size_t index) {
      const auto chunk = static_cast<Index>(index);
      multiply_chunk_transposed(M, runs * chunk / chunks, runs * (chunk + 1) / chunks, X, first, columns,
                                products, chunk, sums);
    });
    sums.finish(M.scale(), first, C);
  }
}

}  // namespace

void multiply(const TallMatrix<double>& M, const ConstFieldRef& C, FieldRef Y, InstructionSet instructions) {
  multiply_tall(M, 0, M.rows(), C, Y, instructions);
}

void multiply_panels(const TallMatrix<double>& M, Index first_panel, const ConstFieldRef& C, FieldRef Y,
                     InstructionSet instructions) {
  multiply_tall(M, first_panel, std::min(Y.rows(), M.rows() - 64 * first_panel), C, Y, instructions);
}
void multiply(const TallMatrix<float>& M, const ConstFieldRef& C, FieldRef Y, InstructionSet instructions) {
  multiply_tall(M, 0, M.rows(), C, Y, instructions);
}

void multiply_panels(const TallMatrix<float>& M, Index first_panel, const ConstFieldRef& C, FieldRef Y,
                     InstructionSet instructions) {
  multiply_tall(M, first_panel, std::min(Y.rows(), M.rows() - 64 * first_panel), C, Y, instructions);
}
void multiply_transposed(const TallMatrix<double>& M, const ConstFieldRef& X, FieldRef C,
                         InstructionSet instructions) {
  multiply_tall_transposed(M, X, C, instructions);
}
void multiply_transposed(const TallMatrix<float>& M, const ConstFieldRef& X, FieldRef C,
                         InstructionSet instructions) {
  multiply_tall_transposed(M, X, C, instructions);
}

}  // namespace radiosity

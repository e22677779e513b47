#include "form_factors/patch_sums.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"

#include <algorithm>

namespace radiosity {
namespace {

using Tiles = SymmetricTiles<double>;

/// Adds the columns of a tile, or the rows of one below the diagonal, to the patches of their elements.
void add_tile(const double* tile, bool transposed, Index rows, Index columns, const int* patches,
              const double* root_area, Eigen::Ref<Eigen::MatrixXd> sums) {
  for (Index c = 0; c < columns; ++c) {
    auto sum = sums.col(patches[c]);
    for (Index r = 0; r < rows; ++r)
      sum[r] += tile[transposed ? Tiles::tile_size * c + r : Tiles::tile_size * r + c] * root_area[c];
  }
}

/// Rows of F_ep = A_e^{-1/2} sum K_ej A_j^{1/2} that belong to one tile row of K.
void sum_tile_row(const Tiles& kernel, Index tile_row, std::span<const int> patches,
                  const Eigen::VectorXd& root_area, Eigen::MatrixXd& sums) {
  constexpr Index size = Tiles::tile_size;
  const Index n = kernel.size();
  const auto extent = [&](Index tile) { return std::min(size, n - size * tile); };
  auto rows = sums.middleRows(size * tile_row, extent(tile_row));
  for (Index column = 0; column < kernel.tile_rows(); ++column) {
    const bool below = column < tile_row;
    const Index tile = below ? kernel.find_tile(column, tile_row) : kernel.find_tile(tile_row, column);
    if (tile < 0) continue;
    add_tile(kernel.tile_data(tile), below, extent(tile_row), extent(column), patches.data() + size * column,
             root_area.data() + size * column, rows);
  }
  rows = (kernel.scale() * root_area.segment(size * tile_row, extent(tile_row)).cwiseInverse()).asDiagonal() *
         rows;
}

}  // namespace

Eigen::MatrixXd patch_sums(const FormFactors& form_factors, std::span<const int> patch_of_element, Index k) {
  const Index n = form_factors.patch_count();
  if (static_cast<Index>(patch_of_element.size()) != n)
    fail<UsageError>("{} elements are assigned to patches, the scene has {}", patch_of_element.size(), n);
  for (const int p : patch_of_element)
    if (p < 0 || p >= k) fail<UsageError>("an element is assigned to patch {}: it must be below {}", p, k);
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(n, k);
  if (form_factors.symmetric()) {
    const Eigen::VectorXd root_area = form_factors.mesh->area.cwiseSqrt();
    parallel_for(static_cast<std::size_t>(form_factors.kernel->tile_rows()), [&](std::size_t row) {
      sum_tile_row(*form_factors.kernel, static_cast<Index>(row), patch_of_element, root_area, sums);
    });
  } else {
    const RowMajorMatrix<double>& matrix = *form_factors.unsymmetric;
    parallel_for(static_cast<std::size_t>(n), [&](std::size_t e) {
      const double* const row = matrix.row(static_cast<Index>(e));
      for (Index j = 0; j < n; ++j)
        sums(static_cast<Index>(e), patch_of_element[static_cast<std::size_t>(j)]) += matrix.scale() * row[j];
    });
  }
  return sums;
}

}  // namespace radiosity

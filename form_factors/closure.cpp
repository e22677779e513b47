#include "form_factors/closure.hpp"

#include "factorizations/symmetric_scaling.hpp"
#include "foundation/parallel.hpp"
#include "kernels/products.hpp"

#include <algorithm>

namespace radiosity {
namespace {

Eigen::VectorXd product(const SymmetricTiles<double>& kernel, const Eigen::VectorXd& x) {
  Eigen::MatrixXd y(x.size(), 1);
  multiply(kernel, x, y);
  return y.col(0);
}

void scale(SymmetricTiles<double>& kernel, const Eigen::VectorXd& d) {
  constexpr Index size = SymmetricTiles<double>::tile_size;
  parallel_for(static_cast<std::size_t>(kernel.tile_rows()), [&](std::size_t row) {
    const auto tile_row = static_cast<Index>(row);
    for (Index tile = kernel.row_begin(tile_row); tile < kernel.row_begin(tile_row + 1); ++tile) {
      double* const entries = kernel.tile_data(tile);
      const Index first_row = tile_row * size, first_col = kernel.tile_column(tile) * size;
      const Index rows = std::min(size, kernel.size() - first_row),
                  cols = std::min(size, kernel.size() - first_col);
      for (Index r = 0; r < rows; ++r)
        for (Index c = 0; c < cols; ++c) entries[r * size + c] *= d[first_row + r] * d[first_col + c];
    }
  });
}

}  // namespace

ClosureResult close_symmetric(SymmetricTiles<double>& kernel, const Eigen::VectorXd& area,
                              const Eigen::VectorXd& target) {
  const auto multiply_kernel = [&](const Eigen::VectorXd& x) { return product(kernel, x); };
  const SymmetricScaling scaling = scale_symmetric(multiply_kernel, area.cwiseSqrt(), target);
  scale(kernel, scaling.factors);
  return {scaling.exists ? "symmetric" : "energy-removing", scaling.note, scaling.sweeps};
}

}  // namespace radiosity

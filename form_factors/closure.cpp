#include "form_factors/closure.hpp"

#include "foundation/parallel.hpp"
#include "kernels/products.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

constexpr int kMostSweeps = 200;
constexpr double kExists = 1e-8;  // a scaling exists if row sums come this close
constexpr double kDone = 1e-13;   // but going on is cheap

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
  const Index n = kernel.size();
  ClosureResult result;
  if (n == 0) return {"symmetric", "", 0};
  const Eigen::VectorXd root_area = area.cwiseSqrt();
  const Eigen::VectorXd first_sums = product(kernel, root_area).cwiseQuotient(root_area);

  Eigen::VectorXd d = Eigen::VectorXd::Ones(n);
  double deviation = 0, best = 1e300;
  int without_gain = 0;
  for (result.sweeps = 0; result.sweeps < kMostSweeps; ++result.sweeps) {
    const Eigen::VectorXd reached = product(kernel, d.cwiseProduct(root_area)).cwiseQuotient(root_area);
    deviation = 0;
    bool possible = true;
    for (Index i = 0; i < n; ++i) {
      if (target[i] <= 0) continue;
      possible &= reached[i] > 0;
      deviation = std::max(deviation, std::abs(d[i] * reached[i] - target[i]));
    }
    if (!possible) {
      deviation = 1;
      break;
    }
    if (deviation <= kDone) break;
    without_gain = deviation < 0.99 * best ? 0 : without_gain + 1;
    best = std::min(best, deviation);
    if (best <= kExists && without_gain > 5) break;  // rounding is reached
    for (Index i = 0; i < n; ++i)
      if (target[i] > 0) d[i] = std::sqrt(d[i] * target[i] / reached[i]);
  }
  const bool exists = deviation <= kExists && d.minCoeff() >= 0.5 && d.maxCoeff() <= 2;
  result.kind = "symmetric";
  if (!exists) {
    result.kind = "energy-removing";
    result.note = fmt::format(
        "no symmetric scaling of F reaches the exposed fractions (deviation {:.1e} after {} sweeps, factors "
        "{:.2g} to "
        "{:.2g}); rows were only scaled down",
        deviation, result.sweeps, d.minCoeff(), d.maxCoeff());
    for (Index i = 0; i < n; ++i)
      d[i] = target[i] > 0 && first_sums[i] > target[i] ? target[i] / first_sums[i] : 1.0;
  }
  scale(kernel, d);
  return result;
}

}  // namespace radiosity

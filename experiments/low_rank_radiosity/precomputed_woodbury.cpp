#include "experiments/low_rank_radiosity/precomputed_woodbury.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "kernels/segment_products.hpp"

#include <algorithm>
#include <utility>

namespace radiosity {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index factor_panel = TallMatrix<float>::panel_rows;

/// -(R U)' of `count` rows, k x count.
MatrixXd reflected_rows(const TallMatrix<float>& U, const VectorXd& reflectance, Index first, Index count) {
  MatrixXd rows(U.columns(), count);
  parallel_for(static_cast<std::size_t>(count), [&](std::size_t index) {
    const auto i = static_cast<Index>(index);
    const Index e = first + i;
    const float* row = U.panel(e / factor_panel) + e % factor_panel;
    const double factor = -reflectance[e] * U.scale();
    for (Index q = 0; q < U.columns(); ++q) rows(q, i) = factor * static_cast<double>(row[q * factor_panel]);
  });
  return rows;
}

/// Rows first ... of Y from their transposes; `first` begins a panel.
void store_rows(const MatrixXd& transposed, Index first, TallMatrix<float>& Y) {
  const Index panels = (transposed.cols() + factor_panel - 1) / factor_panel;
  parallel_for(static_cast<std::size_t>(panels), [&](std::size_t panel) {
    const Index begin = static_cast<Index>(panel) * factor_panel;
    Y.fill_panel(first / factor_panel + static_cast<Index>(panel),
                 transposed.middleCols(begin, std::min(factor_panel, transposed.cols() - begin)).transpose());
  });
}

}  // namespace

CapacitanceMatrix transposed_capacitance(const Segments& V, const TallMatrix<float>& U,
                                         const VectorXd& reflectance) {
  CapacitanceMatrix capacitance(MatrixXd::Identity(U.columns(), U.columns()) -
                                transposed_segment_products(V, reflectance, U));
  constexpr double unit_roundoff = 0x1p-53;
  if (capacitance.reciprocal_condition() < static_cast<double>(U.rows()) * unit_roundoff)
    fail("I - V' R U is singular (reciprocal condition {:.1e}): light never dies out; lower the reflectances",
         capacitance.reciprocal_condition());
  return capacitance;
}

TallMatrix<float> precompute_woodbury(const Segments& V, TallMatrix<float> U, const VectorXd& reflectance,
                                      Monitor& monitor) {
  const CapacitanceMatrix capacitance = transposed_capacitance(V, U, reflectance);
  constexpr Index block_rows = 32 * factor_panel;
  for (Index first = 0; first < U.rows(); first += block_rows) {
    monitor.checkpoint("solving for Y", static_cast<double>(first) / static_cast<double>(U.rows()));
    const Index count = std::min(block_rows, U.rows() - first);
    store_rows(capacitance.solve(reflected_rows(U, reflectance, first, count)), first, U);
  }
  return U;
}

TallMatrix<float> full_matrix(const Segments& V) {
  TallMatrix<float> full(V.rows(), V.count());
  for (Index p = 0; p < V.count(); ++p)
    for (Index s = V.offsets()[static_cast<std::size_t>(p)]; s < V.offsets()[static_cast<std::size_t>(p) + 1];
         ++s)
      full.set(s, p, V.weights().empty() ? 1 : V.weights()[static_cast<std::size_t>(s)]);
  return full;
}

void subtract_product(const TallMatrix<float>& Y, const ConstFieldRef& X, const ConstFieldRef& E,
                      FieldRef B) {
  multiply(Y, X, B);
  constexpr Index rows_of_a_task = 32768;
  const Index tasks = (E.rows() + rows_of_a_task - 1) / rows_of_a_task;
  parallel_for(static_cast<std::size_t>(tasks), [&](std::size_t task) {
    const Index first = static_cast<Index>(task) * rows_of_a_task;
    const Index rows = std::min(rows_of_a_task, E.rows() - first);
    B.middleRows(first, rows) = E.middleRows(first, rows) - B.middleRows(first, rows);
  });
}

}  // namespace radiosity

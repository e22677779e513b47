#include "kernels/row_group_products.hpp"

namespace radiosity {
namespace {

/// Calls visit(row, value) for the entries of an element and moves `values` beyond them.
template <typename Scalar, typename Visit>
void visit_element(const Scalar*& values, unsigned mask, const Visit& visit) {
  constexpr unsigned full = 0xffff;
  if (mask == full)
    for (int row = 0; row < 16; ++row) visit(row, static_cast<double>(*values++));
  else
    for (; mask != 0; mask &= mask - 1) visit(__builtin_ctz(mask), static_cast<double>(*values++));
}

template <typename Scalar, int columns>
void plain_group_to_rows(const RowGroupTask<Scalar>& task) {
  double sums[16 * columns] = {};
  const Scalar* values = task.values;
  for (std::size_t e = 0; e < task.elements; ++e) {
    const double* x = task.x + static_cast<std::ptrdiff_t>(columns) * task.columns[e];
    visit_element(values, task.masks[e], [&](int row, double value) {
      for (int c = 0; c < columns; ++c) sums[16 * c + row] += value * x[c];
    });
  }
  for (int i = 0; i < 16 * columns; ++i) task.y_rows[i] = sums[i];
}

template <typename Scalar, int columns>
void plain_group_to_columns(const RowGroupTask<Scalar>& task) {
  const Scalar* values = task.values;
  for (std::size_t e = 0; e < task.elements; ++e) {
    double sums[columns] = {};
    visit_element(values, task.masks[e], [&](int row, double value) {
      for (int c = 0; c < columns; ++c) sums[c] += value * task.x_rows[16 * c + row];
    });
    double* y = task.y + static_cast<std::ptrdiff_t>(columns) * task.columns[e];
    for (int c = 0; c < columns; ++c) y[c] += sums[c];
  }
}

template <typename Scalar>
void get_plain_products(RowGroupProducts<Scalar>& products) {
  products = {
      {plain_group_to_rows<Scalar, 1>, plain_group_to_rows<Scalar, 2>, plain_group_to_rows<Scalar, 3>},
      {plain_group_to_columns<Scalar, 1>, plain_group_to_columns<Scalar, 2>,
       plain_group_to_columns<Scalar, 3>}};
}

}  // namespace

void get_baseline_row_group_products(RowGroupProducts<double>& f64, RowGroupProducts<float>& f32) {
  get_plain_products(f64);
  get_plain_products(f32);
}

}  // namespace radiosity

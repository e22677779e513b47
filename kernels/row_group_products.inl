// The loops of kernels/row_group_products.hpp in vectors. A file that includes this defines Lanes: what 16
// rows of an element are in its vectors.
//   Lanes::two_sums          elements go to two sums in turn, because an addition takes longer than the rest
//   of one Lanes::Vector            16 doubles Lanes::zero() Lanes::expand(v, mask)   the numbers that follow
//   each other at v, at the places of the mask's bits; zeros elsewhere Lanes::multiply_add(a, x, c)   a x + c
//   for a number x Lanes::add(a, b) Lanes::load, Lanes::store      of 16 doubles Lanes::dot(a, b) their
//   scalar product

namespace radiosity {
namespace {

template <typename Scalar, int columns>
void row_group_to_rows(const RowGroupTask<Scalar>& task) {
  using Vector = Lanes::Vector;
  constexpr int chains = Lanes::two_sums ? 2 : 1;
  Vector sums[chains][columns];
  for (int s = 0; s < chains; ++s)
    for (int c = 0; c < columns; ++c) sums[s][c] = Lanes::zero();
  const Scalar* values = task.values;
  for (std::size_t e = 0; e < task.elements; e += chains)
    for (std::size_t s = 0; s < chains && e + s < task.elements; ++s) {
      const unsigned mask = task.masks[e + s];
      const double* x = task.x + static_cast<std::ptrdiff_t>(columns) * task.columns[e + s];
      const Vector entries = Lanes::expand(values, mask);
      values += __builtin_popcount(mask);
      for (int c = 0; c < columns; ++c) sums[s][c] = Lanes::multiply_add(entries, x[c], sums[s][c]);
    }
  for (int c = 0; c < columns; ++c)
    Lanes::store(task.y_rows + 16 * c,
                 chains == 2 ? Lanes::add(sums[0][c], sums[chains - 1][c]) : sums[0][c]);
}

template <typename Scalar, int columns>
void row_group_to_columns(const RowGroupTask<Scalar>& task) {
  using Vector = Lanes::Vector;
  Vector x[columns];
  for (int c = 0; c < columns; ++c) x[c] = Lanes::load(task.x_rows + 16 * c);
  const Scalar* values = task.values;
  for (std::size_t e = 0; e < task.elements; ++e) {
    const unsigned mask = task.masks[e];
    double* y = task.y + static_cast<std::ptrdiff_t>(columns) * task.columns[e];
    const Vector entries = Lanes::expand(values, mask);
    values += __builtin_popcount(mask);
    for (int c = 0; c < columns; ++c) y[c] += Lanes::dot(entries, x[c]);
  }
}

template <typename Scalar>
void get_row_group_products(RowGroupProducts<Scalar>& products) {
  products = {
      {row_group_to_rows<Scalar, 1>, row_group_to_rows<Scalar, 2>, row_group_to_rows<Scalar, 3>},
      {row_group_to_columns<Scalar, 1>, row_group_to_columns<Scalar, 2>, row_group_to_columns<Scalar, 3>}};
}

}  // namespace
}  // namespace radiosity

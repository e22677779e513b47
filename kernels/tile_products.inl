// The product of one tile, written once for every instruction set. The including file defines, in an unnamed namespace
// so that nothing of it can be linked elsewhere,
//
//   Lanes<double>, Lanes<float>: `Vector` of `width` numbers; zero(), load(), load from Half where float,
//     broadcast(), store(), multiply_add(a, b, c) = a b + c, and
//     row_sums(lanes, sums): sums[r] = sum of the width numbers at lanes + r width, 0 <= r < width;
//   strip_vectors<Number, columns>: how many vectors of a row are worked on together, so that all sums stay in
//     registers; a divisor of 64 / width.

namespace radiosity {
namespace {

constexpr int block = 64;

/// Every entry is loaded (and converted) once and used for `columns` columns in both directions. Rows go in groups of
/// one vector's width, so that the sums along rows end in one transposition a group; columns go in strips.
template <typename Scalar, int columns, bool to_rows, bool to_columns>
void multiply_tile(const TileTask<Scalar>& task) {
  using Number = typename Multiplier<Scalar>::Type;
  using L = Lanes<Number>;
  using Vector = typename L::Vector;
  constexpr int width = L::width;
  constexpr int vectors = strip_vectors<Number, columns>;
  constexpr int strip = width * vectors;

  alignas(64) Number column_sums[columns * block];
  alignas(64) Number row_lanes[columns * width * width];
  if constexpr (to_columns)
    for (int k = 0; k < columns * block; ++k) column_sums[k] = 0;

  for (int group = 0; group < task.rows; group += width) {
    const int group_rows = task.rows - group < width ? task.rows - group : width;
    for (int first = 0; first < block; first += strip) {
      Vector down[columns][vectors];
      if constexpr (to_columns)
        for (int c = 0; c < columns; ++c)
          for (int v = 0; v < vectors; ++v) down[c][v] = L::load(column_sums + c * block + first + v * width);

      for (int r = 0; r < group_rows; ++r) {
        const std::ptrdiff_t offset = (group + r) * task.stride + first;
        Vector entries[vectors];
        for (int v = 0; v < vectors; ++v) entries[v] = L::load(task.entries + offset + v * width);
        if (task.prefetch != nullptr)
          for (int byte = 0; byte < strip * static_cast<int>(sizeof(Scalar)); byte += 64)
            __builtin_prefetch(task.prefetch + offset * static_cast<std::ptrdiff_t>(sizeof(Scalar)) + byte);
        for (int c = 0; c < columns; ++c) {
          if constexpr (to_rows) {
            Number* lanes = row_lanes + (c * width + r) * width;
            Vector across = first == 0 ? L::zero() : L::load(lanes);
            for (int v = 0; v < vectors; ++v)
              across = L::multiply_add(entries[v], L::load(task.x_columns + c * block + first + v * width), across);
            L::store(lanes, across);
          }
          if constexpr (to_columns) {
            const Vector x = L::broadcast(task.x_rows[c * block + group + r]);
            for (int v = 0; v < vectors; ++v) down[c][v] = L::multiply_add(entries[v], x, down[c][v]);
          }
        }
      }

      if constexpr (to_columns)
        for (int c = 0; c < columns; ++c)
          for (int v = 0; v < vectors; ++v) L::store(column_sums + c * block + first + v * width, down[c][v]);
    }

    if constexpr (to_rows)
      for (int c = 0; c < columns; ++c) {
        Number* lanes = row_lanes + c * width * width;
        for (int k = group_rows * width; k < width * width; ++k) lanes[k] = 0;
        alignas(64) Number sums[width];
        L::row_sums(lanes, sums);
        double* y = task.y_rows + c * block + group;
        for (int r = 0; r < width; ++r) y[r] += task.x_columns_scale[c] * static_cast<double>(sums[r]);
      }
  }

  if constexpr (to_columns)
    for (int c = 0; c < columns; ++c)
      for (int k = 0; k < block; ++k)
        task.y_columns[c * block + k] += task.x_rows_scale[c] * static_cast<double>(column_sums[c * block + k]);
}

template <typename Scalar>
void get_products(TileProducts<Scalar>& products) {
  products.both = {multiply_tile<Scalar, 1, true, true>, multiply_tile<Scalar, 2, true, true>,
                   multiply_tile<Scalar, 3, true, true>, multiply_tile<Scalar, 4, true, true>};
  products.to_rows = {multiply_tile<Scalar, 1, true, false>, multiply_tile<Scalar, 2, true, false>,
                      multiply_tile<Scalar, 3, true, false>, multiply_tile<Scalar, 4, true, false>};
  products.to_columns = {multiply_tile<Scalar, 1, false, true>, multiply_tile<Scalar, 2, false, true>,
                         multiply_tile<Scalar, 3, false, true>, multiply_tile<Scalar, 4, false, true>};
}

}  // namespace
}  // namespace radiosity

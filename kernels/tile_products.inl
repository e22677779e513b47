// The product of one tile, written once for every instruction set. The including file defines, in an unnamed
// namespace so that nothing of it can be linked elsewhere,
//
//   Lanes<double>, Lanes<float>: `Vector` of `width` numbers; zero(), load(), load from Half where float,
//     broadcast(), store(), multiply_add(a, b, c) = a b + c,
//     row_sums(lanes): a vector whose r-th number is the sum of the width numbers at lanes + r width, and
//     add_scaled(y, v, s): y[k] += s v[k] in double;
//   strip_vectors<Number, columns>: how many vectors of a row are worked on together (a divisor of 64 /
//   width), and strip_rows<Number, columns, to_columns>: how many rows, so that all sums stay in registers.
//
// Every entry is loaded (and converted) once and used for `columns` columns in both directions. The tile is
// cut into strips of columns. Sums down a strip stay in registers; sums along the rows stay apart by lane in
// memory (in the first cache) over several tiles, because adding up the lanes of a vector costs as much as a
// tile's arithmetic. The order of a column's sums does not depend on how many columns there are.

namespace radiosity {
namespace {

constexpr int block = 64;

template <typename Scalar, int columns, bool to_rows, bool to_columns>
class TileLoop {
 public:
  explicit TileLoop(const TileTask<Scalar>& task)
      : entries_(task.entries),
        stride_(task.stride),
        rows_(task.rows),
        first_(task.first),
        prefetch_(task.prefetch),
        x_columns_(task.x_columns),
        x_rows_(task.x_rows),
        row_lanes_(task.row_lanes) {}

  [[gnu::always_inline]] inline void run(const TileTask<Scalar>& task) const {
    for (int first = 0; first < block; first += strip) multiply_strip(task, first);
    if constexpr (to_rows)
      if (task.last) add_row_sums(task);
  }

 private:
  using Number = typename Multiplier<Scalar>::Type;
  using L = Lanes<Number>;
  using Vector = typename L::Vector;
  static constexpr int width = L::width;
  static constexpr int vectors = strip_vectors<Number, columns>;
  static constexpr int strip = width * vectors;
  static constexpr int rows_together = strip_rows<Number, columns, to_columns>;

  /// All rows, `strip` columns wide from column `first`.
  [[gnu::always_inline]] inline void multiply_strip(const TileTask<Scalar>& task, int first) const {
    const int rows = rows_;
    const bool fresh = first_ && first == 0;
    Vector down[columns][vectors];
#pragma GCC unroll 8
    for (int c = 0; c < columns; ++c)
#pragma GCC unroll 8
      for (int v = 0; v < vectors; ++v) down[c][v] = L::zero();
    int r = 0;
    for (; r + rows_together <= rows; r += rows_together) multiply_rows<rows_together>(r, first, fresh, down);
    for (; r < rows; ++r) multiply_rows<1>(r, first, fresh, down);
    if constexpr (to_columns)
#pragma GCC unroll 8
      for (int c = 0; c < columns; ++c)
#pragma GCC unroll 8
        for (int v = 0; v < vectors; ++v)
          L::add_scaled(task.y_columns + c * block + first + v * width, down[c][v], task.x_rows_scale[c]);
  }

  /// `count` rows side by side, which share the loads of X.
  template <int count>
  [[gnu::always_inline]] inline void multiply_rows(int r, int first, bool fresh,
                                                   Vector (&down)[columns][vectors]) const {
    const Scalar* entries = entries_ + r * stride_ + first;
    fetch_ahead<count>(r * stride_ + first);
    Vector across[columns][count];
    Vector x_rows[columns][count];
#pragma GCC unroll 8
    for (int c = 0; c < columns; ++c)
#pragma GCC unroll 8
      for (int k = 0; k < count; ++k) {
        if constexpr (to_rows) across[c][k] = fresh ? L::zero() : L::load(lanes(c, r + k));
        if constexpr (to_columns) x_rows[c][k] = L::broadcast(x_rows_[c * block + r + k]);
      }
#pragma GCC unroll 8
    for (int v = 0; v < vectors; ++v) {
      Vector entry[count];
#pragma GCC unroll 8
      for (int k = 0; k < count; ++k) entry[k] = L::load(entries + k * stride_ + v * width);
#pragma GCC unroll 8
      for (int c = 0; c < columns; ++c) {
        if constexpr (to_rows) {
          const Vector x = L::load(x_columns_ + c * block + first + v * width);
#pragma GCC unroll 8
          for (int k = 0; k < count; ++k) across[c][k] = L::multiply_add(entry[k], x, across[c][k]);
        }
        if constexpr (to_columns)
#pragma GCC unroll 8
          for (int k = 0; k < count; ++k) down[c][v] = L::multiply_add(entry[k], x_rows[c][k], down[c][v]);
      }
    }
    if constexpr (to_rows)
#pragma GCC unroll 8
      for (int c = 0; c < columns; ++c)
#pragma GCC unroll 8
        for (int k = 0; k < count; ++k) L::store(lanes(c, r + k), across[c][k]);
  }

  template <int count>
  [[gnu::always_inline]] inline void fetch_ahead(std::ptrdiff_t offset) const {
    if (prefetch_ == nullptr) return;
    constexpr int into_second_cache = 2;
    constexpr int strip_bytes = strip * static_cast<int>(sizeof(Scalar));
#pragma GCC unroll 8
    for (int k = 0; k < count; ++k) {
      const char* row = prefetch_ + (offset + k * stride_) * static_cast<std::ptrdiff_t>(sizeof(Scalar));
#pragma GCC unroll 8
      for (int byte = 0; byte < strip_bytes; byte += 64) __builtin_prefetch(row + byte, 0, into_second_cache);
    }
  }

  Number* lanes(int column, int row) const {
    return row_lanes_ + (column * block + row) * width;
  }

  void add_row_sums(const TileTask<Scalar>& task) const {
    const int whole_rows = (rows_ + width - 1) / width * width;
    for (int c = 0; c < columns; ++c) {
      for (int r = rows_; r < whole_rows; ++r) L::store(lanes(c, r), L::zero());
      for (int r = 0; r < whole_rows; r += width)
        L::add_scaled(task.y_rows + c * block + r, L::row_sums(lanes(c, r)), task.x_columns_scale[c]);
    }
  }

  // Copies, which stay in registers: stores of vectors might alias the task.
  const Scalar* entries_;
  std::ptrdiff_t stride_;
  int rows_;
  bool first_;
  const char* prefetch_;
  const Number* x_columns_;
  const Number* x_rows_;
  Number* row_lanes_;
};

template <typename Scalar, int columns, bool to_rows, bool to_columns>
void multiply_tile(const TileTask<Scalar>& task) {
  TileLoop<Scalar, columns, to_rows, to_columns>(task).run(task);
}

template <typename Scalar>
void get_products(TileProducts<Scalar>& products) {
  const TileProducts<Scalar> all = {
      {multiply_tile<Scalar, 1, true, true>, multiply_tile<Scalar, 2, true, true>,
       multiply_tile<Scalar, 3, true, true>},
      {multiply_tile<Scalar, 1, true, false>, multiply_tile<Scalar, 2, true, false>,
       multiply_tile<Scalar, 3, true, false>},
      {multiply_tile<Scalar, 1, false, true>, multiply_tile<Scalar, 2, false, true>,
       multiply_tile<Scalar, 3, false, true>}};
  products = all;
}

}  // namespace
}  // namespace radiosity

// The product of one tile, written once for every instruction set. The including file defines, in an unnamed
// namespace so that nothing of it can be linked elsewhere,
//
//   Lanes<double>, Lanes<float>: `Vector` of `width` numbers; zero(), load(), load from Half where float,
//     broadcast(), store(), multiply_add(a, b, c) = a b + c,
//     row_sums(lanes): a vector whose r-th number is the sum of the width numbers at lanes + r width, and
//     add_scaled(y, v, s): y[k] += s v[k] in double;
//   strip_vectors<Number, columns>: how many vectors of a row are worked on together (a divisor of 64 /
//   width): whole rows where the sums down them fit into registers.
//
// What entries are read from is a class of its own: StoredEntries here, others beside an instruction set that
// can decode faster than it can store and load again. It has the task that it is made from, Task, and
//
//   visit_rows<vectors>(first, visit): visit(r, entry) for every row r from the first on, where entry(v) is
//     vector v of its numbers from column `first` on.
//
// Every entry is loaded (and converted) once and used for `columns` columns in both directions. The tile is
// cut into strips of columns. Sums down a strip stay in registers; sums along the rows stay apart by lane in
// memory (in the first cache) over several tiles, because adding up the lanes of a vector costs as much as a
// tile's arithmetic. The order of a column's sums does not depend on how many columns there are.
//
// Rows are read one after the other, from end to end: reading vector by vector from several rows at once
// saves loads of X, but processors then do not recognize a stream to fetch ahead (Zen 4: 28 GB/s instead of
// 33).

namespace radiosity {
namespace {

constexpr int block = 64;

/// Numbers in memory, row by row.
template <typename Scalar>
class StoredEntries {
 public:
  using Task = TileTask<Scalar>;
  using Number = typename Multiplier<Scalar>::Type;

  explicit StoredEntries(const Task& task)
      : entries_(task.entries),
        stride_(task.stride),
        rows_(task.rows),
        prefetch_(task.prefetch),
        every_line_(task.prefetch_every_line) {}

  template <int vectors, typename Visit>
  [[gnu::always_inline]] inline void visit_rows(int first, Visit visit) const {
    const int rows = rows_;
    for (int r = 0; r < rows; ++r) {
      const Scalar* entries = entries_ + r * stride_ + first;
      fetch_ahead<vectors * L::width>(r * stride_ + first);
      visit(r, [entries](int v) { return L::load(entries + v * L::width); });
    }
  }

 private:
  using L = Lanes<Number>;

  template <int strip>
  [[gnu::always_inline]] inline void fetch_ahead(std::ptrdiff_t offset) const {
    if (prefetch_ == nullptr) return;
    constexpr int into_second_cache = 2;
    constexpr int row_bytes = block * static_cast<int>(sizeof(Scalar));
    const char* row = prefetch_ + offset * static_cast<std::ptrdiff_t>(sizeof(Scalar));
    if (every_line_) {
#pragma GCC unroll 8
      for (int byte = 0; byte < row_bytes * strip / block; byte += 64)
        __builtin_prefetch(row + byte, 0, into_second_cache);
    } else {
      __builtin_prefetch(row, 0, into_second_cache);
    }
  }

  // Copies, which stay in registers: stores of vectors might alias the task.
  const Scalar* entries_;
  std::ptrdiff_t stride_;
  int rows_;
  const char* prefetch_;
  bool every_line_;
};

template <typename Entries, int columns, bool to_rows, bool to_columns>
class TileLoop {
 public:
  using Task = typename Entries::Task;

  explicit TileLoop(const Task& task)
      : entries_(task),
        rows_(task.rows),
        first_(task.first),
        x_columns_(task.x_columns),
        x_rows_(task.x_rows),
        row_lanes_(task.row_lanes) {}

  [[gnu::always_inline]] inline void run(const Task& task) const {
    for (int first = 0; first < block; first += strip) multiply_strip(task, first);
    if constexpr (to_rows)
      if (task.last) add_row_sums(task);
  }

 private:
  using Number = typename Entries::Number;
  using L = Lanes<Number>;
  using Vector = typename L::Vector;
  static constexpr int width = L::width;
  static constexpr int vectors = strip_vectors<Number, columns>;
  static constexpr int strip = width * vectors;

  /// All rows, `strip` columns wide from column `first`.
  [[gnu::always_inline]] inline void multiply_strip(const Task& task, int first) const {
    const bool fresh = first_ && first == 0;
    Vector down[columns][vectors];
#pragma GCC unroll 8
    for (int c = 0; c < columns; ++c)
#pragma GCC unroll 8
      for (int v = 0; v < vectors; ++v) down[c][v] = L::zero();
    entries_.template visit_rows<vectors>(
        first, [&](int r, auto entry)
                   __attribute__((always_inline)) { multiply_row(r, first, fresh, entry, down); });
    if constexpr (to_columns)
#pragma GCC unroll 8
      for (int c = 0; c < columns; ++c)
#pragma GCC unroll 8
        for (int v = 0; v < vectors; ++v)
          L::add_scaled(task.y_columns + c * block + first + v * width, down[c][v], task.x_rows_scale[c]);
  }

  template <typename Entry>
  [[gnu::always_inline]] inline void multiply_row(int r, int first, bool fresh, Entry entry_of,
                                                  Vector (&down)[columns][vectors]) const {
    Vector across[columns];
    Vector x_row[columns];
#pragma GCC unroll 8
    for (int c = 0; c < columns; ++c) {
      if constexpr (to_rows) across[c] = fresh ? L::zero() : L::load(lanes(c, r));
      if constexpr (to_columns) x_row[c] = L::broadcast(x_rows_[c * block + r]);
    }
#pragma GCC unroll 8
    for (int v = 0; v < vectors; ++v) {
      const Vector entry = entry_of(v);
#pragma GCC unroll 8
      for (int c = 0; c < columns; ++c) {
        if constexpr (to_rows)
          across[c] = L::multiply_add(entry, L::load(x_columns_ + c * block + first + v * width), across[c]);
        if constexpr (to_columns) down[c][v] = L::multiply_add(entry, x_row[c], down[c][v]);
      }
    }
    if constexpr (to_rows)
#pragma GCC unroll 8
      for (int c = 0; c < columns; ++c) L::store(lanes(c, r), across[c]);
  }

  Number* lanes(int column, int row) const {
    return row_lanes_ + (column * block + row) * width;
  }

  void add_row_sums(const Task& task) const {
    const int whole_rows = (rows_ + width - 1) / width * width;
    for (int c = 0; c < columns; ++c) {
      for (int r = rows_; r < whole_rows; ++r) L::store(lanes(c, r), L::zero());
      for (int r = 0; r < whole_rows; r += width)
        L::add_scaled(task.y_rows + c * block + r, L::row_sums(lanes(c, r)), task.x_columns_scale[c]);
    }
  }

  Entries entries_;
  int rows_;
  bool first_;
  const Number* x_columns_;
  const Number* x_rows_;
  Number* row_lanes_;
};

template <typename Entries, int columns, bool to_rows, bool to_columns>
void multiply_tile(const typename Entries::Task& task) {
  TileLoop<Entries, columns, to_rows, to_columns>(task).run(task);
}

template <typename Entries, typename Scalar>
void get_products(TileProducts<Scalar>& products) {
  const TileProducts<Scalar> all = {
      {multiply_tile<Entries, 1, true, true>, multiply_tile<Entries, 2, true, true>,
       multiply_tile<Entries, 3, true, true>},
      {multiply_tile<Entries, 1, true, false>, multiply_tile<Entries, 2, true, false>,
       multiply_tile<Entries, 3, true, false>},
      {multiply_tile<Entries, 1, false, true>, multiply_tile<Entries, 2, false, true>,
       multiply_tile<Entries, 3, false, true>}};
  products = all;
}

template <typename Scalar>
void get_products(TileProducts<Scalar>& products) {
  get_products<StoredEntries<Scalar>>(products);
}

}  // namespace
}  // namespace radiosity

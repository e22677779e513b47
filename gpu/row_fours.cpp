#include "gpu/row_fours.hpp"

#include "kernels/side_by_side_rows.hpp"

namespace radiosity {
namespace {

constexpr Index rows_of_four = 4;
constexpr std::size_t least_entries_of_four = 2;

template <typename Scalar>
std::size_t count_fours(const CsrMatrix<Scalar>& matrix) {
  std::size_t count = 0;
  for (Index first = 0; first < matrix.rows(); first += rows_of_four) {
    std::int32_t last = -1;
    visit_side_by_side<rows_of_four>(matrix, first, [&](std::int32_t column, std::size_t, std::size_t) {
      if (column != last) ++count;
      last = column;
    });
  }
  return count;
}

}  // namespace

template <typename Scalar>
std::optional<CsrMatrix<Scalar>> row_fours(const CsrMatrix<Scalar>& matrix) {
  const std::size_t count = count_fours(matrix);
  if (matrix.value.empty() || matrix.value.size() < least_entries_of_four * count) return std::nullopt;
  CsrMatrix<Scalar> fours;
  fours.cols = matrix.cols;
  fours.column.reserve(count);
  fours.value.reserve(rows_of_four * count);
  for (Index first = 0; first < matrix.rows(); first += rows_of_four) {
    const std::size_t begin = fours.column.size();
    visit_side_by_side<rows_of_four>(matrix, first, [&](std::int32_t column, std::size_t r, std::size_t i) {
      if (fours.column.size() == begin || fours.column.back() != column) {
        fours.column.push_back(column);
        fours.value.resize(fours.value.size() + rows_of_four);
      }
      fours.value[fours.value.size() - rows_of_four + r] = matrix.value[i];
    });
    fours.row_begin.push_back(static_cast<std::int64_t>(fours.column.size()));
  }
  return fours;
}

template std::optional<CsrMatrix<float>> row_fours(const CsrMatrix<float>&);
template std::optional<CsrMatrix<double>> row_fours(const CsrMatrix<double>&);

}  // namespace radiosity

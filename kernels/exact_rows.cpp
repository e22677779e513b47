#include "kernels/exact_rows.hpp"

#include "foundation/parallel.hpp"

#include <algorithm>

namespace radiosity {
namespace {

constexpr Index narrow_columns = 65536;
constexpr std::size_t rows_of_a_task = 64;
constexpr Index most_transposed_chunks = 16;

/// sum_k value[k] x[column[k]]: four sums side by side, which do not wait for each other.
template <typename Column>
double gathered_sum(const float* value, const Column* column, std::size_t count, const double* x) {
  double sums[4] = {};
  std::size_t k = 0;
  for (; k + 4 <= count; k += 4)
    for (std::size_t s = 0; s < 4; ++s) sums[s] += static_cast<double>(value[k + s]) * x[column[k + s]];
  for (; k < count; ++k) sums[0] += static_cast<double>(value[k]) * x[column[k]];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

}  // namespace

ExactRows::ExactRows(Index columns, const std::vector<Row>& rows) : columns_(columns), begin_{0} {
  std::size_t count = 0;
  for (const Row& row : rows) begin_.push_back(count += row.value.size());
  values_.reserve(count);
  (columns <= narrow_columns ? narrow_.reserve(count) : wide_.reserve(count));
  for (const Row& row : rows) {
    values_.insert(values_.end(), row.value.begin(), row.value.end());
    for (const std::int32_t column : row.column) {
      if (columns <= narrow_columns)
        narrow_.push_back(static_cast<std::uint16_t>(column));
      else
        wide_.push_back(static_cast<std::uint32_t>(column));
    }
  }
}

template <typename Visit>
void ExactRows::visit_columns(const Visit& visit) const {
  if (columns_ <= narrow_columns)
    visit(narrow_.data());
  else
    visit(wide_.data());
}

void ExactRows::add_product(double scale, const Eigen::Ref<const Eigen::VectorXd>& x,
                            Eigen::Ref<Eigen::VectorXd> y) const {
  visit_columns([&](const auto* columns) {
    parallel_for(
        static_cast<std::size_t>(rows()),
        [&](std::size_t i) {
          y[static_cast<Index>(i)] += scale * gathered_sum(values_.data() + begin_[i], columns + begin_[i],
                                                           begin_[i + 1] - begin_[i], x.data());
        },
        rows_of_a_task);
  });
}

void ExactRows::add_transposed_product(double scale, const Eigen::Ref<const Eigen::VectorXd>& x,
                                       Eigen::Ref<Eigen::VectorXd> y) const {
  const Index chunks = std::min(most_transposed_chunks, rows());
  std::vector<Eigen::VectorXd> sums(static_cast<std::size_t>(chunks), Eigen::VectorXd::Zero(columns_));
  visit_columns([&](const auto* columns) {
    parallel_for(sums.size(), [&](std::size_t chunk) {
      const auto own = static_cast<Index>(chunk);
      for (Index i = rows() * own / chunks; i < rows() * (own + 1) / chunks; ++i)
        for (std::size_t k = begin_[static_cast<std::size_t>(i)]; k < begin_[static_cast<std::size_t>(i) + 1];
             ++k)
          sums[chunk][columns[k]] += static_cast<double>(values_[k]) * x[i];
    });
  });
  for (const Eigen::VectorXd& sum : sums) y += scale * sum;
}

void ExactRows::add_row(Index row, double* numbers) const {
  visit_columns([&](const auto* columns) {
    for (std::size_t k = begin_[static_cast<std::size_t>(row)]; k < begin_[static_cast<std::size_t>(row) + 1];
         ++k)
      numbers[columns[k]] += static_cast<double>(values_[k]);
  });
}

CsrMatrix<float> ExactRows::compressed_rows() const {
  CsrMatrix<float> matrix;
  matrix.cols = columns_;
  matrix.row_begin.assign(begin_.begin(), begin_.end());
  matrix.value = values_;
  visit_columns([&](const auto* column) { matrix.column.assign(column, column + values_.size()); });
  return matrix;
}

}  // namespace radiosity

#include "foundation/parallel.hpp"
#include "kernels/product_shapes.hpp"
#include "kernels/products.hpp"
#include "kernels/row_group_products.hpp"

#include <algorithm>
#include <vector>

namespace radiosity {
namespace {

constexpr Index group_rows = RowGroups<double>::rows_of_group;
constexpr std::size_t groups_of_a_task = 2;
constexpr Index most_chunks_of_groups = 16;

using InterleavedField = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

template <typename Scalar>
RowGroupProducts<Scalar> row_group_products(InstructionSet instructions) {
  RowGroupProducts<double> f64;
  RowGroupProducts<float> f32;
#if defined(RADIOSITY_X86_KERNELS)
  if (instructions == InstructionSet::avx512)
    get_avx512_row_group_products(f64, f32);
  else if (instructions == InstructionSet::avx2)
    get_avx2_row_group_products(f64, f32);
  else
#endif
    get_baseline_row_group_products(f64, f32);
  static_cast<void>(instructions);
  if constexpr (std::is_same_v<Scalar, double>)
    return f64;
  else
    return f32;
}

template <typename Scalar>
RowGroupTask<Scalar> task_of_group(const RowGroups<Scalar>& M, Index g) {
  const auto group = M.group(g);
  RowGroupTask<Scalar> task;
  task.values = group.values;
  task.columns = group.columns;
  task.masks = group.masks;
  task.elements = group.elements;
  return task;
}

template <typename Scalar>
void multiply_groups(const RowGroups<Scalar>& M, const ConstFieldRef& X, FieldRef Y,
                     typename RowGroupProducts<Scalar>::Function to_rows) {
  const InterleavedField x = X;
  parallel_for(
      static_cast<std::size_t>(M.groups()),
      [&](std::size_t g) {
        RowGroupTask<Scalar> task = task_of_group(M, static_cast<Index>(g));
        double y[group_rows * RowGroupProducts<Scalar>::most_columns];
        task.x = x.data();
        task.y_rows = y;
        to_rows(task);
        const Index first = static_cast<Index>(g) * group_rows;
        for (Index c = 0; c < Y.cols(); ++c)
          std::copy_n(y + group_rows * c, std::min(group_rows, M.rows() - first), Y.col(c).data() + first);
      },
      groups_of_a_task);
}

template <typename Scalar>
void multiply_groups_transposed(const RowGroups<Scalar>& M, const ConstFieldRef& X, FieldRef Y,
                                typename RowGroupProducts<Scalar>::Function to_columns) {
  const Index chunks = std::clamp<Index>(static_cast<Index>(M.entries()) / 65536, 1, most_chunks_of_groups);
  std::vector<InterleavedField> sums(static_cast<std::size_t>(chunks));
  parallel_for(sums.size(), [&](std::size_t chunk) {
    const auto own = static_cast<Index>(chunk);
    sums[chunk] = InterleavedField::Zero(M.cols(), X.cols());
    for (Index g = M.groups() * own / chunks; g < M.groups() * (own + 1) / chunks; ++g) {
      RowGroupTask<Scalar> task = task_of_group(M, g);
      double x[group_rows * RowGroupProducts<Scalar>::most_columns] = {};
      for (Index c = 0; c < X.cols(); ++c)
        std::copy_n(X.col(c).data() + g * group_rows, std::min(group_rows, M.rows() - g * group_rows),
                    x + group_rows * c);
      task.x_rows = x;
      task.y = sums[chunk].data();
      to_columns(task);
    }
  });
  for (std::size_t chunk = 1; chunk < sums.size(); ++chunk) sums[0] += sums[chunk];
  Y = sums[0];
}

/// Calls multiply(X, Y, i) for one to three columns at a time, i: how many less one.
template <typename Multiply>
void for_few_columns(const ConstFieldRef& X, FieldRef Y, const Multiply& multiply) {
  constexpr Index together = RowGroupProducts<double>::most_columns;
  for (Index first = 0; first < X.cols(); first += together) {
    const Index columns = std::min(together, X.cols() - first);
    multiply(X.middleCols(first, columns), Y.middleCols(first, columns),
             static_cast<std::size_t>(columns) - 1);
  }
}

template <typename Scalar>
void multiply_in_groups(const RowGroups<Scalar>& M, const ConstFieldRef& X, FieldRef Y,
                        InstructionSet instructions) {
  check_product_shapes(M.rows(), M.cols(), X, Y);
  const auto products = row_group_products<Scalar>(instructions);
  for_few_columns(X, Y, [&](const ConstFieldRef& some, FieldRef result, std::size_t which) {
    multiply_groups(M, some, result, products.to_rows[which]);
  });
}

template <typename Scalar>
void multiply_in_groups_transposed(const RowGroups<Scalar>& M, const ConstFieldRef& X, FieldRef Y,
                                   InstructionSet instructions) {
  check_product_shapes(M.cols(), M.rows(), X, Y);
  const auto products = row_group_products<Scalar>(instructions);
  for_few_columns(X, Y, [&](const ConstFieldRef& some, FieldRef result, std::size_t which) {
    multiply_groups_transposed(M, some, result, products.to_columns[which]);
  });
}

}  // namespace

void multiply(const RowGroups<double>& M, const ConstFieldRef& X, FieldRef Y, InstructionSet instructions) {
  multiply_in_groups(M, X, Y, instructions);
}
void multiply(const RowGroups<float>& M, const ConstFieldRef& X, FieldRef Y, InstructionSet instructions) {
  multiply_in_groups(M, X, Y, instructions);
}
void multiply_transposed(const RowGroups<double>& M, const ConstFieldRef& X, FieldRef Y,
                         InstructionSet instructions) {
  multiply_in_groups_transposed(M, X, Y, instructions);
}
void multiply_transposed(const RowGroups<float>& M, const ConstFieldRef& X, FieldRef Y,
                         InstructionSet instructions) {
  multiply_in_groups_transposed(M, X, Y, instructions);
}

}  // namespace radiosity

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "kernels/products.hpp"
#include "kernels/row_groups.hpp"
#include "product_reference.hpp"

#include <bit>

namespace radiosity {
namespace {

/// `there` of the entries, by chance; in some groups of rows all or none.
Eigen::MatrixXd thinned_matrix(Index rows, Index cols, double there, std::uint64_t seed) {
  Eigen::MatrixXd matrix = random_matrix(rows, cols, seed);
  RandomStream random(seed + 1);
  for (Index i = 0; i < rows; ++i)
    for (Index j = 0; j < cols; ++j) {
      const double probability = i / 16 % 4 == 2 ? 0 : i / 16 % 4 == 3 ? 1 : there;
      if (random.uniform() >= probability) matrix(i, j) = 0;
    }
  return matrix;
}

template <typename Scalar>
class RowGroupsOf : public testing::Test {};
using RowGroupTypes = testing::Types<double, float>;
TYPED_TEST_SUITE(RowGroupsOf, RowGroupTypes);

TYPED_TEST(RowGroupsOf, HoldTheMatrixTheyAreMadeOf) {
  for (const Index rows : hard_sizes()) {
    const auto matrix = compress<TypeParam>(RowMajorMatrix<double>(thinned_matrix(rows, 90, 0.3, 41)));
    const RowGroups<TypeParam> groups(matrix);
    const CsrMatrix<TypeParam> again = groups.compressed_rows();
    EXPECT_EQ(again.row_begin, matrix.row_begin) << rows;
    EXPECT_EQ(again.column, matrix.column) << rows;
    EXPECT_EQ(again.value, matrix.value) << rows;
    EXPECT_EQ(again.cols, matrix.cols);
    EXPECT_EQ(groups.value_bytes(), matrix.value_bytes());
  }
}

TYPED_TEST(RowGroupsOf, HaveAnElementForEachColumnThatAGroupHasEntriesIn) {
  const Eigen::MatrixXd matrix = thinned_matrix(70, 50, 0.1, 42);
  const RowGroups<TypeParam> groups(compress<TypeParam>(RowMajorMatrix<double>(matrix)));
  ASSERT_EQ(groups.groups(), 5);
  for (Index g = 0; g < 5; ++g) {
    const Eigen::MatrixXd rows = matrix.middleRows(16 * g, std::min<Index>(16, 70 - 16 * g));
    const auto group = groups.group(g);
    std::size_t next = 0;
    for (Index j = 0; j < 50; ++j) {
      const Index entries = (rows.col(j).array() != 0).count();
      if (entries == 0) continue;
      ASSERT_LT(next, group.elements);
      EXPECT_EQ(group.columns[next], j);
      EXPECT_EQ(std::popcount(group.masks[next]), entries);
      ++next;
    }
    EXPECT_EQ(next, group.elements);
  }
}

TYPED_TEST(RowGroupsOf, MultiplyWithinTheirBoundWithEveryInstructionSet) {
  for (const InstructionSet instructions : available_instruction_sets())
    for (const Index n : hard_sizes())
      for (const Index columns : {0, 1, 2, 3, 8}) {
        const Eigen::MatrixXd matrix = thinned_matrix(n, 2 * n, 0.4, 43);
        const Eigen::MatrixXd stored = matrix.cast<TypeParam>().template cast<double>();
        const RowGroups<TypeParam> M(compress<TypeParam>(RowMajorMatrix<double>(matrix)));
        const Eigen::MatrixXd X = random_matrix(2 * n, columns, 44);
        Eigen::MatrixXd Y(n, columns);
        multiply(M, X, Y, instructions);
        EXPECT_TRUE(within_product_bound(stored, X, Y, unit_roundoff<double>()))
            << name(instructions) << ' ' << n << ", " << columns;
        const Eigen::MatrixXd W = random_matrix(n, columns, 45);
        Eigen::MatrixXd Z(2 * n, columns);
        multiply_transposed(M, W, Z, instructions);
        EXPECT_TRUE(within_product_bound(stored.transpose(), W, Z, 2 * unit_roundoff<double>()))
            << name(instructions) << ' ' << n << ", " << columns;
      }
}

TYPED_TEST(RowGroupsOf, GiveAColumnTheSameBitsWhateverComesWithItAndOnAnyNumberOfThreads) {
  constexpr Index n = 900;
  const RowGroups<TypeParam> M(compress<TypeParam>(RowMajorMatrix<double>(thinned_matrix(n, n, 0.4, 46))));
  const Eigen::MatrixXd X = random_matrix(n, 5, 47);
  for (const InstructionSet instructions : available_instruction_sets()) {
    Eigen::MatrixXd Y(n, 5);
    Eigen::MatrixXd Z(n, 5);
    multiply(M, X, Y, instructions);
    multiply_transposed(M, X, Z, instructions);
    for (const int threads : {1, 2, 8}) {
      const ThreadLimit limit(threads);
      for (Index c = 0; c < 5; ++c) {
        Eigen::MatrixXd one(n, 1);
        multiply(M, X.col(c), one, instructions);
        EXPECT_EQ(one, Y.col(c)) << name(instructions) << ' ' << threads;
        multiply_transposed(M, X.col(c), one, instructions);
        EXPECT_EQ(one, Z.col(c)) << name(instructions) << ' ' << threads;
      }
    }
  }
}

TYPED_TEST(RowGroupsOf, RefuseFieldsOfOtherShapes) {
  const RowGroups<TypeParam> M(compress<TypeParam>(RowMajorMatrix<double>(thinned_matrix(7, 80, 0.4, 48))));
  Eigen::MatrixXd Y(7, 2);
  EXPECT_THROW(multiply(M, Eigen::MatrixXd(7, 2), Y), UsageError);
  EXPECT_THROW(multiply_transposed(M, Eigen::MatrixXd(80, 2), Y), UsageError);
}

}  // namespace
}  // namespace radiosity

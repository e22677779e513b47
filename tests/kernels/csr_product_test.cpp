#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "kernels/products.hpp"
#include "product_reference.hpp"

namespace radiosity {
namespace {

/// About two thirds of the entries are zero, and one row and one column are.
Eigen::MatrixXd sparse_symmetric_matrix(Index n, std::uint64_t seed) {
  Eigen::MatrixXd matrix = random_symmetric_matrix(n, seed);
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i)
      if ((i + j) % 3 != 0 || i == n / 2 || j == n / 2) matrix(i, j) = 0;
  return matrix;
}

template <typename Scalar>
class CsrProduct : public testing::Test {};
using CsrTypes = testing::Types<double, float>;
TYPED_TEST_SUITE(CsrProduct, CsrTypes);

TYPED_TEST(CsrProduct, MeetsItsBoundForEverySize) {
  for (const Index n : hard_sizes())
    for (const Index columns : {0, 1, 2, 3, 17}) {
      const Eigen::MatrixXd matrix = sparse_symmetric_matrix(n, 31);
      const Eigen::MatrixXd stored = matrix.cast<TypeParam>().template cast<double>();
      const auto M = compress<TypeParam>(tiles_of(matrix));
      const Eigen::MatrixXd X = random_matrix(n, columns, 32);
      Eigen::MatrixXd Y(n, columns);
      multiply(M, X, Y);
      EXPECT_TRUE(within_product_bound(stored, X, Y, unit_roundoff<double>())) << n << ", " << columns;
      multiply_transposed(M, X, Y);
      EXPECT_TRUE(within_product_bound(stored.transpose(), X, Y, unit_roundoff<double>()))
          << n << ", " << columns;
    }
}

TYPED_TEST(CsrProduct, KeepsExactlyTheEntriesThatAreNotZeroInRisingColumns) {
  const Eigen::MatrixXd matrix = sparse_symmetric_matrix(150, 33);
  const auto from_tiles = compress<TypeParam>(tiles_of(matrix));
  const auto from_rows = compress<TypeParam>(RowMajorMatrix<double>(matrix));
  EXPECT_EQ(static_cast<Index>(from_tiles.value.size()), (matrix.array() != 0).count());
  EXPECT_EQ(from_tiles.row_begin, from_rows.row_begin);
  EXPECT_EQ(from_tiles.column, from_rows.column);
  EXPECT_EQ(from_tiles.value, from_rows.value);
  for (Index i = 0; i < 150; ++i)
    for (auto k = from_tiles.row_begin[static_cast<std::size_t>(i)] + 1;
         k < from_tiles.row_begin[static_cast<std::size_t>(i) + 1]; ++k)
      EXPECT_LT(from_tiles.column[static_cast<std::size_t>(k) - 1],
                from_tiles.column[static_cast<std::size_t>(k)]);
  EXPECT_EQ(from_tiles.value_bytes(), from_tiles.value.size() * sizeof(TypeParam));
  EXPECT_EQ(from_tiles.index_bytes(), from_tiles.value.size() * 4 + 151 * 8);
}

TYPED_TEST(CsrProduct, MultipliesAMatrixThatIsNotSquare) {
  const Eigen::MatrixXd matrix = random_matrix(7, 80, 34);
  const Eigen::MatrixXd stored = matrix.cast<TypeParam>().template cast<double>();
  const auto M = compress<TypeParam>(RowMajorMatrix<double>(matrix));
  Eigen::MatrixXd Y(7, 2);
  const Eigen::MatrixXd X = random_matrix(80, 2, 35);
  multiply(M, X, Y);
  EXPECT_TRUE(within_product_bound(stored, X, Y, unit_roundoff<double>()));
  Eigen::MatrixXd Z(80, 2);
  const Eigen::MatrixXd W = random_matrix(7, 2, 36);
  multiply_transposed(M, W, Z);
  EXPECT_TRUE(within_product_bound(stored.transpose(), W, Z, unit_roundoff<double>()));
  EXPECT_THROW(multiply(M, W, Z), UsageError);
}

TYPED_TEST(CsrProduct, DoesNotDependOnThreads) {
  const Index n = 900;
  const auto M = compress<TypeParam>(tiles_of(sparse_symmetric_matrix(n, 37)));
  const Eigen::MatrixXd X = random_matrix(n, 2, 38);
  Eigen::MatrixXd first(n, 2);
  Eigen::MatrixXd first_transposed(n, 2);
  multiply(M, X, first);
  multiply_transposed(M, X, first_transposed);
  for (const int threads : {1, 2, 8}) {
    const ThreadLimit limit(threads);
    Eigen::MatrixXd again(n, 2);
    multiply(M, X, again);
    EXPECT_EQ(first, again) << threads;
    multiply_transposed(M, X, again);
    EXPECT_EQ(first_transposed, again) << threads;
  }
}

}  // namespace
}  // namespace radiosity

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "kernels/products.hpp"
#include "product_reference.hpp"

#include <algorithm>
#include <limits>

namespace radiosity {
namespace {

template <typename Scalar>
Eigen::MatrixXd stored_values(const RowMajorMatrix<Scalar>& M) {
  Eigen::MatrixXd matrix(M.rows(), M.cols());
  for (Index j = 0; j < M.cols(); ++j)
    for (Index i = 0; i < M.rows(); ++i) matrix(i, j) = M(i, j);
  return matrix;
}

template <typename Scalar>
class RowMajorProduct : public testing::Test {
 protected:
  static void expect_right(Index rows, Index cols, Index columns) {
    const RowMajorMatrix<Scalar> M(random_matrix(rows, cols, 3));
    const Eigen::MatrixXd stored = stored_values(M);
    const Eigen::MatrixXd X = random_matrix(cols, columns, 4);
    const Eigen::MatrixXd Z = random_matrix(rows, columns, 5);
    for (const InstructionSet set : available_instruction_sets()) {
      SCOPED_TRACE(std::string(name(set)) + ", " + std::to_string(rows) + " x " + std::to_string(cols) +
                   ", " + std::to_string(columns) + " columns");
      const double nan = std::numeric_limits<double>::quiet_NaN();
      Eigen::MatrixXd Y = Eigen::MatrixXd::Constant(rows, columns, nan);
      multiply(M, X, Y, set);
      EXPECT_TRUE(within_product_bound(stored, X, Y, unit_roundoff<Scalar>()));
      Y = Eigen::MatrixXd::Constant(cols, columns, nan);
      multiply_transposed(M, Z, Y, set);
      EXPECT_TRUE(within_product_bound(stored.transpose(), Z, Y, unit_roundoff<Scalar>()));
    }
  }
};
TYPED_TEST_SUITE(RowMajorProduct, StorageTypes);

TYPED_TEST(RowMajorProduct, MeetsItsBoundForEverySize) {
  for (const Index n : hard_sizes()) this->expect_right(n, n, 1);
  for (const Index n : {1, 17, 65}) {
    this->expect_right(n, 300, 3);
    this->expect_right(300, n, 3);
  }
}

TYPED_TEST(RowMajorProduct, MeetsItsBoundForAnyNumberOfColumns) {
  for (Index columns = 0; columns <= 17; ++columns) this->expect_right(70, 130, columns);
}

TYPED_TEST(RowMajorProduct, DoesNotDependOnThreads) {
  const RowMajorMatrix<TypeParam> M(random_matrix(1100, 300, 6));
  const Eigen::MatrixXd X = random_matrix(300, 2, 7);
  const Eigen::MatrixXd Z = random_matrix(1100, 2, 8);
  Eigen::MatrixXd first(1100, 2);
  Eigen::MatrixXd first_transposed(300, 2);
  multiply(M, X, first);
  multiply_transposed(M, Z, first_transposed);
  for (const int threads : {1, 2, 8}) {
    const ThreadLimit limit(threads);
    Eigen::MatrixXd again(1100, 2);
    Eigen::MatrixXd again_transposed(300, 2);
    multiply(M, X, again);
    multiply_transposed(M, Z, again_transposed);
    EXPECT_EQ(first, again) << threads;
    EXPECT_EQ(first_transposed, again_transposed) << threads;
  }
}

TYPED_TEST(RowMajorProduct, RefusesShapesThatDoNotFit) {
  const RowMajorMatrix<TypeParam> M(random_matrix(4, 6, 9));
  Eigen::MatrixXd four(4, 1);
  Eigen::MatrixXd six(6, 1);
  EXPECT_THROW(multiply(M, four, six), UsageError);
  EXPECT_THROW(multiply_transposed(M, six, four), UsageError);
}

TYPED_TEST(RowMajorProduct, StoresWithinTheTypesRoundoff) {
  const Eigen::MatrixXd matrix = random_matrix(9, 70, 10);
  const RowMajorMatrix<TypeParam> M(matrix);
  const auto converted = convert<TypeParam>(RowMajorMatrix<double>(matrix));
  const double underflow = underflow_error<TypeParam>() * M.scale();
  for (Index j = 0; j < 70; ++j)
    for (Index i = 0; i < 9; ++i) {
      EXPECT_LE(std::fabs(M(i, j) - matrix(i, j)),
                std::max(unit_roundoff<TypeParam>() * std::fabs(matrix(i, j)), underflow));
      EXPECT_EQ(converted(i, j), M(i, j));
    }
  EXPECT_EQ(M.entry_bytes(), 9u * 128u * sizeof(TypeParam));
}

}  // namespace
}  // namespace radiosity

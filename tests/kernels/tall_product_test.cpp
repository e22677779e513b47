#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "kernels/products.hpp"
#include "product_reference.hpp"

#include <algorithm>
#include <limits>

namespace radiosity {
namespace {

template <typename Scalar>
Eigen::MatrixXd stored_values(const TallMatrix<Scalar>& M) {
  Eigen::MatrixXd matrix(M.rows(), M.columns());
  for (Index p = 0; p < M.columns(); ++p)
    for (Index e = 0; e < M.rows(); ++e) matrix(e, p) = M(e, p);
  return matrix;
}

template <typename Scalar>
class TallProduct : public testing::Test {
 protected:
  static void expect_right(Index rows, Index rank, Index columns) {
    const TallMatrix<Scalar> M(random_matrix(rows, rank, 41));
    const Eigen::MatrixXd stored = stored_values(M);
    const Eigen::MatrixXd C = random_matrix(rank, columns, 42);
    const Eigen::MatrixXd X = random_matrix(rows, columns, 43);
    for (const InstructionSet set : available_instruction_sets()) {
      SCOPED_TRACE(std::string(name(set)) + ", " + std::to_string(rows) + " x " + std::to_string(rank) +
                   ", " + std::to_string(columns) + " columns");
      const double nan = std::numeric_limits<double>::quiet_NaN();
      Eigen::MatrixXd Y = Eigen::MatrixXd::Constant(rows, columns, nan);
      multiply(M, C, Y, set);
      EXPECT_TRUE(within_product_bound(stored, C, Y, unit_roundoff<Scalar>()));
      Y = Eigen::MatrixXd::Constant(rank, columns, nan);
      multiply_transposed(M, X, Y, set);
      EXPECT_TRUE(within_product_bound(stored.transpose(), X, Y, unit_roundoff<Scalar>()));
    }
  }
};
using TallTypes = testing::Types<double, float>;
TYPED_TEST_SUITE(TallProduct, TallTypes);

TYPED_TEST(TallProduct, MeetsItsBoundForEverySize) {
  for (const Index rows : {0, 1, 63, 64, 65, 257, 700})
    for (const Index rank : {0, 1, 24, 64, 65, 216, 333}) this->expect_right(rows, rank, 1);
}

TYPED_TEST(TallProduct, MeetsItsBoundForAnyNumberOfColumns) {
  for (Index columns = 0; columns <= 17; ++columns) this->expect_right(330, 70, columns);
}

TYPED_TEST(TallProduct, DoesNotDependOnThreads) {
  const TallMatrix<TypeParam> M(random_matrix(3000, 216, 44));
  const Eigen::MatrixXd C = random_matrix(216, 4, 45);
  const Eigen::MatrixXd X = random_matrix(3000, 4, 46);
  Eigen::MatrixXd first(3000, 4);
  Eigen::MatrixXd first_transposed(216, 4);
  multiply(M, C, first);
  multiply_transposed(M, X, first_transposed);
  for (const int threads : {1, 2, 8}) {
    const ThreadLimit limit(threads);
    Eigen::MatrixXd again(3000, 4);
    Eigen::MatrixXd again_transposed(216, 4);
    multiply(M, C, again);
    multiply_transposed(M, X, again_transposed);
    EXPECT_EQ(first, again) << threads;
    EXPECT_EQ(first_transposed, again_transposed) << threads;
  }
}

TYPED_TEST(TallProduct, GivesAColumnTheSameBitsInAnyCompany) {
  const TallMatrix<TypeParam> M(random_matrix(500, 100, 47));
  const Eigen::MatrixXd C = random_matrix(100, 7, 48);
  const Eigen::MatrixXd X = random_matrix(500, 7, 49);
  for (const InstructionSet set : available_instruction_sets()) {
    Eigen::MatrixXd together(500, 7);
    Eigen::MatrixXd together_transposed(100, 7);
    multiply(M, C, together, set);
    multiply_transposed(M, X, together_transposed, set);
    for (Index c = 0; c < 7; ++c) {
      Eigen::MatrixXd alone(500, 1);
      Eigen::MatrixXd alone_transposed(100, 1);
      multiply(M, C.col(c), alone, set);
      multiply_transposed(M, X.col(c), alone_transposed, set);
      EXPECT_EQ(alone, together.col(c)) << name(set) << ", column " << c;
      EXPECT_EQ(alone_transposed, together_transposed.col(c)) << name(set) << ", column " << c;
    }
  }
}

TYPED_TEST(TallProduct, BoundFailsWithoutTheLastRowOrColumn) {
  const Eigen::MatrixXd matrix = random_matrix(129, 65, 50) + Eigen::MatrixXd::Ones(129, 65);
  TallMatrix<TypeParam> M(matrix);
  const Eigen::MatrixXd stored = stored_values(M);
  const Eigen::MatrixXd C = Eigen::MatrixXd::Ones(65, 1);
  const Eigen::MatrixXd X = Eigen::MatrixXd::Ones(129, 1);
  for (Index e = 0; e < 129; ++e) M.set(e, 64, 0);
  for (Index p = 0; p < 65; ++p) M.set(128, p, 0);
  Eigen::MatrixXd Y(129, 1);
  multiply(M, C, Y);
  EXPECT_FALSE(within_product_bound(stored, C, Y, unit_roundoff<TypeParam>()));
  Eigen::MatrixXd sums(65, 1);
  multiply_transposed(M, X, sums);
  EXPECT_FALSE(within_product_bound(stored.transpose(), X, sums, unit_roundoff<TypeParam>()));
}

TYPED_TEST(TallProduct, KeepsNumbersFarFromOneInRange) {
  // Products of such entries and fields would overflow in float, or vanish.
  for (const double magnitude : {1e-30, 1e30}) {
    const Eigen::MatrixXd matrix = magnitude * random_matrix(200, 40, 51);
    const TallMatrix<TypeParam> M(matrix);
    const Eigen::MatrixXd stored = stored_values(M);
    const Eigen::MatrixXd C = magnitude * random_matrix(40, 2, 52);
    const Eigen::MatrixXd X = magnitude * random_matrix(200, 2, 53);
    Eigen::MatrixXd Y(200, 2);
    multiply(M, C, Y);
    EXPECT_TRUE(within_product_bound(stored, C, Y, unit_roundoff<TypeParam>()));
    Eigen::MatrixXd sums(40, 2);
    multiply_transposed(M, X, sums);
    EXPECT_TRUE(within_product_bound(stored.transpose(), X, sums, unit_roundoff<TypeParam>()));
  }
}

TYPED_TEST(TallProduct, RefusesShapesThatDoNotFit) {
  const TallMatrix<TypeParam> M(random_matrix(6, 4, 54));
  Eigen::MatrixXd four(4, 1);
  Eigen::MatrixXd six(6, 1);
  EXPECT_THROW(multiply(M, six, four), UsageError);
  EXPECT_THROW(multiply_transposed(M, four, six), UsageError);
}

}  // namespace
}  // namespace radiosity

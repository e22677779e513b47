#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "kernels/products.hpp"
#include "product_reference.hpp"

#include <limits>

namespace radiosity {
namespace {

template <typename Scalar>
class SymmetricProduct : public testing::Test {
 protected:
  static void expect_right(const SymmetricTiles<Scalar>& K, const Eigen::MatrixXd& X) {
    const Eigen::MatrixXd stored = materialize(K);
    for (const InstructionSet set : available_instruction_sets()) {
      SCOPED_TRACE(std::string(name(set)) + " n " + std::to_string(K.size()) + " columns " +
                   std::to_string(X.cols()));
      Eigen::MatrixXd Y =
          Eigen::MatrixXd::Constant(K.size(), X.cols(), std::numeric_limits<double>::quiet_NaN());
      multiply(K, X, Y, set);
      EXPECT_TRUE(within_product_bound(stored, X, Y, unit_roundoff<Scalar>()));
    }
  }
};
TYPED_TEST_SUITE(SymmetricProduct, StorageTypes);

TYPED_TEST(SymmetricProduct, MeetsItsBoundForEverySize) {
  for (const Index n : hard_sizes())
    for (const Index columns : {1, 3})
      this->expect_right(convert<TypeParam>(tiles_of(random_symmetric_matrix(n, 7))),
                         random_matrix(n, columns, 8));
}

TYPED_TEST(SymmetricProduct, MeetsItsBoundForAnyNumberOfColumns) {
  const auto K = convert<TypeParam>(tiles_of(random_symmetric_matrix(130, 9)));
  for (Index columns = 0; columns <= 17; ++columns) this->expect_right(K, random_matrix(130, columns, 10));
  this->expect_right(K, random_matrix(130, 35, 11));
}

TEST(SymmetricProductOfDouble, MeetsTheBoundOfItsTreeOfSums) {
  const Index n = 2500;
  const auto K = tiles_of(random_symmetric_matrix(n, 27));
  const Eigen::MatrixXd X = random_matrix(n, 2, 28);
  const double fewer_sums = tiled_product_error(n) / (2 * static_cast<double>(n));
  EXPECT_LT(fewer_sums, 0.2 * unit_roundoff<double>());
  for (const InstructionSet set : available_instruction_sets()) {
    Eigen::MatrixXd Y(n, 2);
    multiply(K, X, Y, set);
    EXPECT_TRUE(within_product_bound(materialize(K), X, Y, fewer_sums)) << name(set);
  }
}

TYPED_TEST(SymmetricProduct, SkipsTilesThatAreNotKept) {
  const Index n = 600;
  const Eigen::MatrixXd full = random_symmetric_matrix(n, 12);
  const auto banded = [](Index I, Index J) { return J - I == 1 || J - I == 5; };
  this->expect_right(convert<TypeParam>(tiles_of(full, banded)), random_matrix(n, 3, 13));
  const auto none = [](Index, Index) { return false; };
  const auto K = convert<TypeParam>(tiles_of(full, none));
  Eigen::MatrixXd Y = Eigen::MatrixXd::Constant(n, 2, 5);
  multiply(K, random_matrix(n, 2, 14), Y);
  EXPECT_EQ(Y, Eigen::MatrixXd::Zero(n, 2));
}

TYPED_TEST(SymmetricProduct, KeepsItsBoundWhereFieldsDifferByHundredsOfDecades) {
  const Index n = 600;
  const auto diagonal = [](Index I, Index J) { return I / 4 == J / 4; };  // rooms of 256 patches
  Eigen::MatrixXd X = random_matrix(n, 3, 15);
  X.middleRows(256, 256) *= 1e-200;
  X.bottomRows(88) *= 1e250;
  X.col(1) *= 1e-40;
  this->expect_right(convert<TypeParam>(tiles_of(random_symmetric_matrix(n, 16), diagonal)), X);
}

TYPED_TEST(SymmetricProduct, DoesNotDependOnThreadsOrRepetition) {
  const Index n = 1500;
  const auto K = convert<TypeParam>(tiles_of(random_symmetric_matrix(n, 17)));
  const Eigen::MatrixXd X = random_matrix(n, 3, 18);
  for (const InstructionSet set : available_instruction_sets()) {
    Eigen::MatrixXd first(n, 3);
    multiply(K, X, first, set);
    for (const int threads : {1, 2, 8, 8}) {
      const ThreadLimit limit(threads);
      Eigen::MatrixXd again(n, 3);
      multiply(K, X, again, set);
      EXPECT_EQ(first, again) << name(set) << ", " << threads << " threads";
    }
  }
}

TYPED_TEST(SymmetricProduct, TreatsEveryColumnAsIfItWereAlone) {
  const Index n = 300;
  const auto K = convert<TypeParam>(tiles_of(random_symmetric_matrix(n, 19)));
  const Eigen::MatrixXd X = random_matrix(n, 17, 20);
  for (const InstructionSet set : available_instruction_sets()) {
    Eigen::MatrixXd together(n, 17);
    multiply(K, X, together, set);
    for (Index j = 0; j < 17; ++j) {
      Eigen::MatrixXd alone(n, 1);
      multiply(K, X.col(j), alone, set);
      EXPECT_EQ(alone.col(0), together.col(j)) << name(set) << ", column " << j;
    }
  }
}

TYPED_TEST(SymmetricProduct, WritesNothingOutsideY) {
  for (const Index n : {1, 33, 65}) {
    const auto K = convert<TypeParam>(tiles_of(random_symmetric_matrix(n, 21)));
    Eigen::MatrixXd larger = Eigen::MatrixXd::Constant(n + 70, 5, -3);
    for (const InstructionSet set : available_instruction_sets())
      multiply(K, random_matrix(n, 3, 22), larger.block(2, 1, n, 3), set);
    larger.block(2, 1, n, 3).setConstant(-3);
    EXPECT_EQ(larger, Eigen::MatrixXd::Constant(n + 70, 5, -3));
  }
}

TYPED_TEST(SymmetricProduct, PassesNaNOn) {
  const auto K = convert<TypeParam>(tiles_of(Eigen::MatrixXd::Ones(70, 70)));
  Eigen::MatrixXd X = Eigen::MatrixXd::Ones(70, 1);
  X(66, 0) = std::numeric_limits<double>::quiet_NaN();
  Eigen::MatrixXd Y(70, 1);
  for (const InstructionSet set : available_instruction_sets()) {
    multiply(K, X, Y, set);
    EXPECT_TRUE(Y.array().isNaN().all()) << name(set);
  }
}

TYPED_TEST(SymmetricProduct, RefusesShapesThatDoNotFit) {
  const auto K = convert<TypeParam>(tiles_of(Eigen::MatrixXd::Ones(4, 4)));
  Eigen::MatrixXd Y(4, 1);
  EXPECT_THROW(multiply(K, Eigen::MatrixXd::Ones(5, 1), Y), UsageError);
  EXPECT_THROW(multiply(K, Eigen::MatrixXd::Ones(4, 2), Y), UsageError);
}

// The bound is sharp enough to notice one lost entry and a float32 sum where double was promised.
TEST(ProductBound, NoticesMistakes) {
  Eigen::MatrixXd K = random_symmetric_matrix(100, 23);
  Eigen::MatrixXd X = random_matrix(100, 1, 24);
  K(17, 60) = 1;
  X(60, 0) = 1;
  Eigen::MatrixXd lossy = K;
  lossy(17, 60) = 0;
  EXPECT_TRUE(within_product_bound(K, X, K * X, unit_roundoff<double>()));
  EXPECT_FALSE(within_product_bound(K, X, lossy * X, unit_roundoff<float>()));
  const Eigen::MatrixXd in_float = (K.cast<float>() * X.cast<float>()).cast<double>();
  EXPECT_FALSE(within_product_bound(K, X, in_float, unit_roundoff<double>()));
  Eigen::MatrixXd not_a_number = K * X;
  not_a_number(3, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(within_product_bound(K, X, not_a_number, unit_roundoff<Half>()));
}

}  // namespace
}  // namespace radiosity

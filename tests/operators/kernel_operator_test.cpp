#include "foundation/error.hpp"
#include "operators/kernel_operator.hpp"
#include "operators/operator_registry.hpp"
#include "tests/conformance/transport_cases.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <memory>

namespace radiosity {
namespace {

class KernelOperatorTest : public testing::Test {
 protected:
  static constexpr Index n = 70;
  Eigen::MatrixXd kernel_ = random_kernel(n, 2);
  Eigen::VectorXd area_ = Eigen::VectorXd::LinSpaced(n, 0.01, 40);
  Eigen::MatrixXd reflectance_ = (Eigen::MatrixXd::Random(n, 3).array() + 1) / 2.5;
  FormFactors form_factors_ = symmetric_form_factors(kernel_, area_, reflectance_);
  std::unique_ptr<LinearOperator> transport_ = cpu_operators().make("dense", form_factors_);
  KernelOperator& operator_ = dynamic_cast<KernelOperator&>(*transport_);

  /// T of a channel by its definition.
  Eigen::MatrixXd transport(Index channel) const {
    const Eigen::VectorXd root = area_.cwiseSqrt();
    return reflectance_.col(channel).cwiseQuotient(root).asDiagonal() * kernel_ * root.asDiagonal();
  }
};

TEST_F(KernelOperatorTest, PutsTheDiagonalsAroundTheKernelChannelByChannel) {
  const Field X = Field::Random(n, 6);
  Field Y(n, 6);
  Field Z(n, 6);
  operator_.apply(X, Y);
  operator_.apply_transposed(1, X, 0, Z);
  for (Index j = 0; j < 6; ++j) {
    const Eigen::MatrixXd T = transport(j % 3);
    EXPECT_LE((Y.col(j) - T * X.col(j)).norm(), 1e-13 * Y.col(j).norm());
    EXPECT_LE((Z.col(j) - T.transpose() * X.col(j)).norm(), 1e-13 * Z.col(j).norm());
  }
}

TEST_F(KernelOperatorTest, KernelProductsTakeAnyNumberOfColumns) {
  const Field X = Field::Random(n, 4);
  Field Y = Field::Constant(n, 4, std::numeric_limits<double>::quiet_NaN());
  operator_.apply_kernel(X, Y);
  EXPECT_LE((Y - kernel_ * X).norm(), 1e-13 * Y.norm());
  Field shared = X;
  EXPECT_THROW(operator_.apply_kernel(shared, shared), UsageError);
}

TEST_F(KernelOperatorTest, TransposedScalesAsApplyDoes) {
  const Field X = Field::Random(n, 3);
  const Field before = Field::Random(n, 3);
  Field product(n, 3);
  operator_.apply_transposed(1, X, 0, product);
  Field Y = before;
  operator_.apply_transposed(-2, X, 0.5, Y);
  EXPECT_LE((Y - (0.5 * before - 2 * product)).norm(), 1e-14 * Y.norm());
  Y = before;
  operator_.apply_transposed(0, Field::Constant(n, 3, std::numeric_limits<double>::quiet_NaN()), 2, Y);
  EXPECT_EQ(Y, 2 * before);
  EXPECT_THROW(operator_.apply_transposed(1, Y, 0, Y), UsageError);
}

TEST_F(KernelOperatorTest, TakesAnotherReflectance) {
  reflectance_ = Eigen::MatrixXd::Constant(n, 3, 0.25);
  operator_.set_reflectance(reflectance_);
  const Field X = Field::Random(n, 3);
  Field Y(n, 3);
  operator_.apply(X, Y);
  EXPECT_LE((Y - transport(0) * X).norm(), 1e-13 * Y.norm());

  EXPECT_THROW(operator_.set_reflectance(Eigen::MatrixXd::Constant(n, 1, 0.5)), UsageError);
  EXPECT_THROW(operator_.set_reflectance(Eigen::MatrixXd::Constant(n, 3, 1.01)), UsageError);
  EXPECT_THROW(operator_.set_reflectance(Eigen::MatrixXd::Constant(n, 3, -0.1)), UsageError);
  EXPECT_THROW(operator_.set_reflectance(Eigen::MatrixXd::Constant(n + 1, 3, 0.5)), UsageError);
}

TEST_F(KernelOperatorTest, CountsColumnsDividedByChannels) {
  const Field X = Field::Random(n, 6);
  Field Y(n, 6);
  operator_.apply(X, Y);
  EXPECT_EQ(operator_.usage().products, 2u);
  operator_.apply_transposed(1, X, 0, Y);
  EXPECT_EQ(operator_.usage().products, 4u);
  operator_.apply_kernel(X.leftCols(2), Y.leftCols(2));
  EXPECT_EQ(operator_.usage().products, 6u);
  operator_.apply(0, X, 0, Y);
  EXPECT_EQ(operator_.usage().products, 6u);
  EXPECT_GT(operator_.usage().seconds, 0);
}

}  // namespace
}  // namespace radiosity

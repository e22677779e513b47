#include "foundation/parallel.hpp"
#include "operators/operator_checks.hpp"
#include "tests/conformance/transport_cases.hpp"

#include <gtest/gtest.h>

// Every check must be able to fail: an operator with one deliberate fault fails the check that is for it.

namespace radiosity {
namespace {

enum class Fault {
  none,
  drops_column,
  reads_y_at_beta_zero,
  ignores_alpha,
  reads_padding,
  writes_padding,
  fills_zero_rows,
  depends_on_threads,
  depends_on_history,
  transposes_wrongly,
  certifies_too_little,
};

/// T by plain loops over a full matrix in one channel, with one fault.
class FaultyOperator final : public LinearOperator, public TransposedApply {
 public:
  FaultyOperator(const OperatorReference& reference, Fault fault)
      : matrix_(reference.matrix.front().cast<double>()), fault_(fault) {}

  Index size() const override { return matrix_.rows(); }
  Index channels() const override { return 1; }
  ByteCount bytes() const override { return {}; }
  std::string describe() const override { return "faulty"; }
  Certificate certificate() const override {
    const double bound = fault_ == Fault::certifies_too_little ? 1e-12 : 1.0;
    const double error = fault_ == Fault::certifies_too_little ? 1e-18 : 1e-12;
    return {bound * matrix_.rowwise().sum().maxCoeff(), error, "proved"};
  }

  void apply_transposed(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const override {
    const Field product =
        fault_ == Fault::transposes_wrongly ? Field(matrix_ * X) : Field(matrix_.transpose() * X);
    Y = alpha * product + (beta == 0 ? Field::Zero(Y.rows(), Y.cols()) : Field(beta * Y));
  }

 protected:
  void apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const override {
    Field product = matrix_ * X;
    if (fault_ == Fault::drops_column) product -= matrix_.col(size() - 1) * X.row(size() - 1);
    if (fault_ == Fault::fills_zero_rows) product.array() += 1e-300;
    if (fault_ == Fault::depends_on_threads && ThreadLimit::current() == 2) product *= 1 + 0x1p-52;
    if (fault_ == Fault::depends_on_history) product *= 1 + 0x1p-52 * static_cast<double>(usage().products);
    // One row too far, where there is such a row: in a field that is a block of a larger one.
    if (fault_ == Fault::reads_padding && X.outerStride() > size()) product(0, 0) += 0 * X.data()[size()];
    if (fault_ == Fault::writes_padding && Y.outerStride() > size()) Y.data()[size()] = 0;
    if (fault_ == Fault::ignores_alpha) alpha = 1;
    if (beta == 0 && fault_ != Fault::reads_y_at_beta_zero)
      Y = alpha * product;
    else
      Y = alpha * product + beta * Y;
  }

 private:
  Eigen::MatrixXd matrix_;
  Fault fault_;
};

class BrokenOperators : public testing::Test {
 protected:
  static constexpr Index n = 33;
  /// One channel, with a row of zeros.
  TransportCase data_ = transport_cases(n)[3];

  FaultyOperator faulty(Fault fault) const { return {data_.reference, fault}; }
};

TEST_F(BrokenOperators, WithoutAFaultAllChecksPass) {
  EXPECT_EQ(check_operator(faulty(Fault::none), data_.reference), "");
  EXPECT_EQ(check_operator(faulty(Fault::none), own_entries(faulty(Fault::none))), "");
  EXPECT_EQ(check_certificate(faulty(Fault::none), data_.reference, data_.root_area), "");
}

TEST_F(BrokenOperators, ADroppedColumnFails) {
  EXPECT_NE(check_products(faulty(Fault::drops_column), data_.reference), "");
}

TEST_F(BrokenOperators, ReadingYFails) {
  EXPECT_EQ(check_scaling(faulty(Fault::reads_y_at_beta_zero)), "beta = 0 reads Y");
}

TEST_F(BrokenOperators, AForgottenFactorFails) {
  EXPECT_NE(check_scaling(faulty(Fault::ignores_alpha)), "");
}

TEST_F(BrokenOperators, LeakingPaddingFails) {
  EXPECT_EQ(check_exact_zeros(faulty(Fault::reads_padding), data_.reference),
            "what lies around X leaks into the result");
  EXPECT_EQ(check_exact_zeros(faulty(Fault::writes_padding), data_.reference),
            "something around Y is written");
}

TEST_F(BrokenOperators, NumbersWhereTIsZeroFail) {
  EXPECT_NE(check_exact_zeros(faulty(Fault::fills_zero_rows), data_.reference), "");
}

TEST_F(BrokenOperators, DependingOnThreadsFails) {
  EXPECT_NE(check_repeatability(faulty(Fault::depends_on_threads)), "");
}

TEST_F(BrokenOperators, DependingOnHistoryFails) {
  EXPECT_NE(check_repeatability(faulty(Fault::depends_on_history)), "");
}

TEST_F(BrokenOperators, AWrongTransposeFails) {
  EXPECT_NE(check_transposed(faulty(Fault::transposes_wrongly), data_.reference), "");
}

TEST_F(BrokenOperators, ATooSmallCertificateFails) {
  EXPECT_NE(check_certificate(faulty(Fault::certifies_too_little), data_.reference, data_.root_area), "");
}

TEST_F(BrokenOperators, ALossThatTheCertificateDoesNotCoverFails) {
  EXPECT_NE(check_certificate(faulty(Fault::drops_column), data_.reference, data_.root_area), "");
}

TEST_F(BrokenOperators, FloatArithmeticFailsTheDoubleBound) {
  OperatorReference rounded = data_.reference;
  rounded.matrix.front() = data_.reference.matrix.front().cast<float>().cast<long double>();
  const FaultyOperator in_float(rounded, Fault::none);
  EXPECT_NE(check_products(in_float, data_.reference), "");
  rounded = data_.reference;
  rounded.unit_roundoff = 0x1p-24;
  EXPECT_EQ(check_products(in_float, rounded), "");
}

}  // namespace
}  // namespace radiosity

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "kernels/products.hpp"
#include "kernels/sparse_powers.hpp"
#include "product_reference.hpp"

#include <Eigen/LU>

#include <cmath>
#include <string>

namespace radiosity {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

CsrMatrix<double> sparse(const MatrixXd& matrix) {
  return compress<double>(RowMajorMatrix<double>(matrix));
}

SparsePowers powers_of(const MatrixXd& matrix, const SparsePowersOptions& options) {
  return sum_sparse_powers(sparse(matrix), VectorXd::Ones(matrix.rows()), options);
}

MatrixXd full(const CsrMatrix<float>& matrix) {
  MatrixXd result(matrix.rows(), matrix.cols);
  multiply(matrix, MatrixXd::Identity(matrix.cols, matrix.cols), result);
  return result;
}

/// Entries over two decades, rows that sum to 0.9 at most, of unequal weights.
MatrixXd contraction(Index n) {
  MatrixXd matrix = random_matrix(n, n, 41).array().abs().pow(3);
  matrix *= 0.9 / matrix.rowwise().sum().maxCoeff();
  return matrix;
}

MatrixXd exact_sum(const MatrixXd& matrix) {
  const MatrixXd identity = MatrixXd::Identity(matrix.rows(), matrix.cols());
  return (identity - matrix).inverse() - identity;
}

TEST(SparsePowers, OfTwoRowsAreTheOnesByHand) {
  MatrixXd matrix(2, 2);
  matrix << 0, 0.5, 0.25, 0;
  const SparsePowers two = powers_of(matrix, {.threshold = 0.1});
  MatrixXd expected(2, 2);
  expected << 0.125, 0.5, 0.25, 0.125;  // the third power is 0.0625 and 0.03125
  EXPECT_EQ(full(two.sum), expected);
  EXPECT_EQ(two.powers, 2);
  EXPECT_EQ(two.remainder, 0);
  expected << 0, 0.5, 0.25, 0;
  const SparsePowers one = powers_of(matrix, {.most_powers = 1});
  EXPECT_EQ(full(one.sum), expected);
  EXPECT_EQ(one.powers, 1);
}

TEST(SparsePowers, DropsByWeighedEntriesAndKeepsPlainOnes) {
  MatrixXd matrix(2, 2);
  matrix << 0, 0.5, 0.25, 0;
  const SparsePowers powers = sum_sparse_powers(sparse(matrix), VectorXd{{2, 1}}, {.threshold = 0.13});
  MatrixXd expected(2, 2);
  expected << 0, 0.5, 0, 0;  // weighed, 0.25 is 0.125
  EXPECT_EQ(full(powers.sum), expected);
  EXPECT_EQ(powers.powers, 1);
}

TEST(SparsePowers, WithoutAThresholdAreTheInverse) {
  for (const Index n : {0, 1, 2, 17, 65}) {
    const MatrixXd matrix = n > 0 ? contraction(n) : MatrixXd();
    const SparsePowers powers = powers_of(matrix, {});
    if (n == 0) continue;
    const MatrixXd exact = exact_sum(matrix);
    EXPECT_LE((full(powers.sum) - exact).norm(), 0x1p-22 * exact.norm()) << n;
    EXPECT_LE(powers.remainder, 0x1p-24);
    if (n < 17) continue;
    const SparsePowers few = powers_of(matrix, {.most_powers = 3});
    EXPECT_GT((full(few.sum) - exact).norm(), 1e-2 * exact.norm()) << n;
    EXPECT_GT(few.remainder, 1e-2) << "what is missing is said";
  }
}

TEST(SparsePowers, LoseMoreWithEveryThreshold) {
  const MatrixXd matrix = contraction(80);
  const MatrixXd exact = exact_sum(matrix);
  double error = 1e-7;
  std::size_t entries = 80 * 80;
  for (const double threshold : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    const SparsePowers powers = powers_of(matrix, {.threshold = threshold});
    const double next = (full(powers.sum) - exact).norm() / exact.norm();
    EXPECT_GT(next, error) << threshold;
    EXPECT_LE(powers.sum.value.size(), entries) << threshold;
    error = next;
    entries = powers.sum.value.size();
  }
  EXPECT_LT(entries, 80 * 80 / 2);
}

TEST(SparsePowers, AreTheSameForAnyNumberOfThreads) {
  const MatrixXd matrix = contraction(100);
  const SparsePowers first = powers_of(matrix, {.threshold = 1e-4});
  for (const int threads : {1, 2, 8}) {
    const ThreadLimit limit(threads);
    const SparsePowers again = powers_of(matrix, {.threshold = 1e-4});
    EXPECT_EQ(again.sum.row_begin, first.sum.row_begin);
    EXPECT_EQ(again.sum.column, first.sum.column);
    EXPECT_EQ(again.sum.value, first.sum.value);
    EXPECT_EQ(again.powers, first.powers);
  }
}

std::string refusal(const MatrixXd& matrix, const SparsePowersOptions& options) {
  try {
    powers_of(matrix, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SparsePowers, RefuseWhatDoesNotFitOrEnd) {
  const MatrixXd matrix = contraction(40);
  EXPECT_EQ(refusal(matrix, {.most_bytes = 40 * 40 * 8}), "");
  EXPECT_NE(refusal(matrix, {.most_bytes = 40 * 40 * 8 - 1}).find("raise the threshold"), std::string::npos);
  EXPECT_NE(refusal(MatrixXd::Constant(40, 40, 2.0 / 40), {}).find("grow without end"), std::string::npos);
  EXPECT_THROW(sum_sparse_powers(sparse(matrix), VectorXd::Ones(3), {}), UsageError);
}

}  // namespace
}  // namespace radiosity

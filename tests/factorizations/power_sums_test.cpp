#include "factorizations/matrix_products.hpp"
#include "factorizations/power_sums.hpp"
#include "foundation/error.hpp"

#include <gtest/gtest.h>

namespace radiosity {
namespace {

using Eigen::MatrixXd;

/// Non-negative, with row sums of `radius`.
MatrixXd losing(Eigen::Index n, double radius, std::uint64_t seed) {
  const MatrixXd matrix = normal_numbers(n, n, seed).cwiseAbs();
  return radius * matrix.rowwise().sum().cwiseInverse().asDiagonal() * matrix;
}

MatrixXd plain_sum(const MatrixXd& A, const MatrixXd& B, long terms) {
  MatrixXd power = B, sum = B;
  for (long h = 1; h < terms; ++h) sum += power = (A * power).eval();
  return sum;
}

TEST(PowerSum, AddsUpAllPowersByHornerAndByDoubling) {
  const MatrixXd A = losing(20, 0.97, 1), B = normal_numbers(20, 7, 2);
  for (long terms = 1; terms <= 70; ++terms) {
    const MatrixXd expected = plain_sum(A, B, terms);
    EXPECT_LE((power_sum(A, B, terms) - expected).norm(), 1e-13 * expected.norm()) << terms;
    // One term more or less would be seen.
    EXPECT_GT((power_sum(A, B, terms + 1) - expected).norm(), 1e-4 * expected.norm()) << terms;
  }
  EXPECT_THROW(power_sum(A, B, 0), UsageError);
}

TEST(PowerSum, GeometricSumsAreTheirLimit) {
  const MatrixXd A = losing(20, 0.9, 3), B = normal_numbers(20, 20, 4).cwiseAbs();
  EXPECT_LE((geometric_sum(A, B) - plain_sum(A, B, 400)).norm(), 1e-12 * B.norm() / 0.1);
  EXPECT_EQ(geometric_sum(MatrixXd(0, 0), MatrixXd(0, 0)).size(), 0);
}

TEST(PowerSum, SumsThatDoNotExistAreRefused) {
  const MatrixXd B = MatrixXd::Identity(20, 20);
  EXPECT_NO_THROW(geometric_sum(losing(20, 0.999999, 5), B));
  EXPECT_THROW(geometric_sum(losing(20, 1, 5), B), Error);
  EXPECT_THROW(geometric_sum(losing(20, 1.0001, 5), B), Error);
  EXPECT_THROW(geometric_sum(losing(20, 7, 5), B), Error);
}

}  // namespace
}  // namespace radiosity

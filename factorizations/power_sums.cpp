#include "factorizations/power_sums.hpp"

#include "factorizations/lapack.hpp"
#include "foundation/error.hpp"

#include <cblas.h>

#include <bit>
#include <utility>

namespace radiosity {
namespace {

using Eigen::MatrixXd;

/// A X + Y.
MatrixXd product_sum(const MatrixXd& A, const MatrixXd& X, MatrixXd Y) {
  if (A.rows() == 0 || X.cols() == 0) return Y;
  const auto as_blas = [](Eigen::Index size) { return static_cast<blasint>(size); };
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, as_blas(A.rows()), as_blas(X.cols()),
              as_blas(A.cols()), 1, A.data(), as_blas(A.rows()), X.data(), as_blas(X.rows()), 1, Y.data(),
              as_blas(Y.rows()));
  return Y;
}

MatrixXd horner_sum(const MatrixXd& A, const MatrixXd& B, long terms) {
  MatrixXd sum = B;
  for (long h = 1; h < terms; ++h) sum = product_sum(A, sum, B);
  return sum;
}

int bits_of(long terms) {
  return static_cast<int>(std::bit_width(static_cast<unsigned long>(terms)));
}

/// How many products doubling_sum takes.
long doubling_products(long terms) {
  long products = 0;
  for (int bit = bits_of(terms) - 2; bit >= 0; --bit) {
    products += 1 + (terms >> bit & 1);               // of the sum
    if (bit > 0) products += 1 + (terms >> bit & 1);  // of the power
  }
  return products;
}

/// From the highest bit of `terms` on: with t terms and A^t, 2 t terms are S + A^t S, and one more B + A S.
MatrixXd doubling_sum(const MatrixXd& A, const MatrixXd& B, long terms) {
  MatrixXd sum = B;
  MatrixXd power = A;
  const MatrixXd nothing = MatrixXd::Zero(A.rows(), A.cols());
  for (int bit = bits_of(terms) - 2; bit >= 0; --bit) {
    const bool one_more = (terms >> bit & 1) != 0;
    sum = product_sum(power, sum, sum);
    if (one_more) sum = product_sum(A, sum, B);
    if (bit == 0) break;
    power = product_sum(power, power, nothing);
    if (one_more) power = product_sum(A, power, nothing);
  }
  return sum;
}

}  // namespace

MatrixXd power_sum(const MatrixXd& A, const MatrixXd& B, long terms) {
  if (terms < 1) fail<UsageError>("a sum of {} powers: take at least 1", terms);
  return doubling_products(terms) < terms - 1 ? doubling_sum(A, B, terms) : horner_sum(A, B, terms);
}

MatrixXd geometric_sum(const MatrixXd& A, MatrixXd B) {
  const LuFactors factors(MatrixXd::Identity(A.rows(), A.cols()) - A);
  const bool singular = A.rows() > 0 && !(factors.reciprocal_condition() > 0x1p-53);
  if (singular || (A.rows() > 0 && !(factors.solve(MatrixXd::Ones(A.rows(), 1)).minCoeff() >= 0)))
    fail(
        "the sum of all bounces does not exist, since light does not lose energy at every bounce: lower the "
        "reflectance (--max-reflectance)");
  return factors.solve(std::move(B));
}

}  // namespace radiosity

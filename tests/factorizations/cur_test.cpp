#include "factorizations/cur.hpp"
#include "factorizations/lapack.hpp"
#include "factorizations/leading_columns.hpp"
#include "hard_matrices.hpp"
#include "test_ratios.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace radiosity::testing {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr CurCore both_cores[] = {CurCore::projection, CurCore::interpolation};

/// ||A - U V'||_F / ||A||_F.
double relative_error(const MatrixXd& A, const LowRankPair& pair) {
  const double scale = A.cwiseAbs().maxCoeff();
  return (A / scale - pair.U / scale * pair.V.transpose()).norm() / (A / scale).norm();
}

/// The same over the optimum of that rank.
double over_best(const MatrixXd& A, const LowRankPair& pair) {
  const SingularValues svd = singular_value_decomposition(A);
  const Index rank = pair.U.cols();
  const LowRankPair best = {svd.U.leftCols(rank) * svd.values.head(rank).asDiagonal(), svd.V.leftCols(rank)};
  return relative_error(A, pair) / std::max(relative_error(A, best), 1e-13);
}

TEST(LeadingColumns, AreAsGoodAsThoseOfTheWholeMatrix) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    for (const HardMatrix& hard : hard_matrices(seed)) {
      if (hard.name == "zero") continue;
      const MatrixProducts products = MatrixProducts::of(hard.matrix);
      const std::vector<Index> picked = leading_columns(products, 12, seed);
      ASSERT_EQ(picked.size(), 12U) << hard.name;
      std::vector<Index> pivots = pivoted_qr(hard.matrix).pivots;
      pivots.resize(12);
      const double error =
          relative_error(hard.matrix, project_on_columns(products, columns_of(products, picked)));
      const double by_all =
          relative_error(hard.matrix, project_on_columns(products, columns_of(products, pivots)));
      EXPECT_LE(error, 2 * by_all + 1e-13) << hard.name << ", seed " << seed;
    }
}

TEST(LeadingColumns, ArePivotsOfTheMatrixWhereTheSketchHasItsRows) {
  const MatrixXd A = matrix_with_values(40, 90, geometric_values(40, 100), 5);
  std::vector<Index> pivots = pivoted_qr(A).pivots;
  pivots.resize(35);
  EXPECT_EQ(leading_columns(MatrixProducts::of(A), 35, 1), pivots);
  EXPECT_TRUE(leading_columns(MatrixProducts::of(MatrixXd::Zero(5, 4)), 3, 1).empty());
}

TEST(BasisProjection, LeavesDependentColumnsOut) {
  const MatrixXd A = matrix_with_values(50, 30, geometric_values(30, 10), 6);
  MatrixXd basis = A.leftCols(8);
  basis.col(3) = basis.col(1) - 2 * basis.col(6);
  basis.col(5).setZero();
  const LowRankPair pair = project_on_columns(MatrixProducts::of(A), basis);
  EXPECT_EQ(pair.U.cols(), 6);
  EXPECT_EQ(pair.V.cols(), 6);
  EXPECT_LE(orthogonality(pair.U), 50);
  const MatrixXd dependent = pair.U * pair.V.transpose();
  for (const Index column : {0, 1, 2, 4, 6, 7})
    EXPECT_LE((dependent.col(column) - A.col(column)).norm(), 1e-13) << column;
  EXPECT_GT((dependent.col(3) - A.col(3)).norm(), 1e-3);
}

TEST(Cur, ReproducesAMatrixOfItsRank) {
  const MatrixXd A = matrix_with_values(70, 50, geometric_values(7, 1e3), 4);
  for (const CurCore core : both_cores) {
    for (const Index rank : {7, 20}) {
      const CurDecomposition cur = cur_decomposition(MatrixProducts::of(A), {.rank = rank, .core = core});
      EXPECT_EQ(cur.columns.size(), 7U);
      EXPECT_EQ(cur.rows.size(), 7U);
      EXPECT_LE(relative_error(A, cur.factors), 1e-12);
    }
    EXPECT_GT(relative_error(A, cur_decomposition(MatrixProducts::of(A), {.rank = 6, .core = core}).factors),
              1e-5);
  }
}

TEST(Cur, IsNearTheOptimumAndTheProjectionIsTheBetterCore) {
  for (const HardMatrix& hard : hard_matrices(8)) {
    if (hard.name == "zero") continue;
    double ratio[2];
    std::vector<Index> rows[2];
    for (const CurCore core : both_cores) {
      const auto cur = cur_decomposition(MatrixProducts::of(hard.matrix), {.rank = 12, .core = core});
      const auto which = static_cast<std::size_t>(core);
      ratio[which] = over_best(hard.matrix, cur.factors);
      rows[which] = cur.rows;
    }
    EXPECT_EQ(rows[0], rows[1]) << hard.name;
    EXPECT_LE(ratio[0], ratio[1] + 1) << hard.name;
    EXPECT_LE(ratio[0], 5) << hard.name;
    EXPECT_LE(ratio[1], 20) << hard.name;
  }
}

TEST(Cur, OfZeroIsEmpty) {
  for (const CurCore core : both_cores) {
    const MatrixXd zero = MatrixXd::Zero(6, 5);
    const CurDecomposition cur = cur_decomposition(MatrixProducts::of(zero), {.rank = 3, .core = core});
    EXPECT_EQ(cur.factors.U.cols(), 0);
    EXPECT_EQ(cur.factors.U.rows(), 6);
    EXPECT_EQ(cur.factors.V.rows(), 5);
  }
}

}  // namespace
}  // namespace radiosity::testing

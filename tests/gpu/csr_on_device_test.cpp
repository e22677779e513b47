#include "foundation/random.hpp"
#include "gpu/csr_on_device.hpp"
#include "gpu/row_fours.hpp"
#include "tests/gpu/device_test.hpp"

#include <cmath>
#include <limits>

namespace radiosity {
namespace {

/// A random matrix whose blocks of `side` x 1 are there, all of them full, with `probability`.
template <typename Scalar>
CsrMatrix<Scalar> random_sparse(Index rows, Index cols, Index side, double probability) {
  RandomStream random(1);
  const Eigen::MatrixXd there = Eigen::MatrixXd::NullaryExpr(
      (rows + side - 1) / side, cols, [&] { return random.uniform() < probability ? 1.0 : 0.0; });
  CsrMatrix<Scalar> matrix;
  matrix.cols = cols;
  for (Index r = 0; r < rows; ++r) {
    for (Index c = 0; c < cols; ++c)
      if (there(r / side, c) > 0) {
        matrix.column.push_back(static_cast<std::int32_t>(c));
        matrix.value.push_back(static_cast<Scalar>(0.1 + random.uniform()));
      }
    matrix.row_begin.push_back(static_cast<std::int64_t>(matrix.column.size()));
  }
  return matrix;
}

/// Of which each row of `stored` stands for `together` of the matrix'.
template <typename Scalar>
Eigen::MatrixXd in_full(const CsrMatrix<Scalar>& stored, Index rows, Index together) {
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(stored.rows() * together, stored.cols);
  for (Index row = 0; row < stored.rows(); ++row)
    for (std::int64_t i = stored.row_begin[static_cast<std::size_t>(row)];
         i < stored.row_begin[static_cast<std::size_t>(row) + 1]; ++i)
      for (Index r = 0; r < together; ++r)
        full(row * together + r, stored.column[static_cast<std::size_t>(i)]) +=
            static_cast<double>(stored.value[static_cast<std::size_t>(i * together + r)]);
  EXPECT_EQ(full.bottomRows(full.rows() - rows).cwiseAbs().sum(), 0);
  return full.topRows(rows);
}

TEST(RowFours, HoldTheSameMatrixWhateverItsNumberOfRows) {
  for (const Index rows : {1, 4, 30, 31, 32}) {
    const auto matrix = random_sparse<double>(rows, 50, 4, 0.3);
    const auto fours = row_fours(matrix);
    ASSERT_EQ(fours.has_value(), rows > 1);
    if (!fours) continue;
    EXPECT_EQ(in_full(*fours, rows, 4), in_full(matrix, rows, 1)) << rows;
  }
}

TEST(RowFours, HaveRisingColumnsEachOnce) {
  const auto fours = row_fours(random_sparse<float>(40, 200, 2, 0.7));
  ASSERT_TRUE(fours.has_value());
  for (Index row = 0; row < fours->rows(); ++row)
    for (auto i = static_cast<std::size_t>(fours->row_begin[static_cast<std::size_t>(row)]) + 1;
         i < static_cast<std::size_t>(fours->row_begin[static_cast<std::size_t>(row) + 1]); ++i)
      EXPECT_LT(fours->column[i - 1], fours->column[i]);
}

TEST(RowFours, AreNotMadeOfRowsThatShareFewColumns) {
  EXPECT_FALSE(row_fours(random_sparse<float>(64, 64, 1, 0.1)).has_value());
  EXPECT_TRUE(row_fours(random_sparse<float>(64, 64, 1, 0.9)).has_value());
  EXPECT_FALSE(row_fours(CsrMatrix<float>{}).has_value());
}

class SparseOnDevices : public DeviceTest {
 protected:
  /// The largest |M X - Y| in units of 2 (n + 8) u |M| |X|, the bound of D1.
  template <typename Scalar>
  static double worst(const CsrMatrix<Scalar>& matrix, const CsrOnDevice<Scalar>& copy, Index columns) {
    RandomStream random(3);
    const Field X = Field::NullaryExpr(matrix.cols, columns, [&] { return random.uniform() - 0.5; });
    Field Y(matrix.rows(), columns);
    copy.multiply(X, Y);
    const Eigen::MatrixXd M = in_full(matrix, matrix.rows(), 1);
    const double u = static_cast<double>(std::numeric_limits<Scalar>::epsilon()) / 2;
    const Eigen::ArrayXXd bound =
        2 * static_cast<double>(matrix.cols + 8) * u * (M.cwiseAbs() * X.cwiseAbs()).array();
    return ((M * X - Y).array().abs() / bound.max(std::numeric_limits<double>::min())).maxCoeff();
  }

  template <typename Scalar>
  static void expect_right_products() {
    for (const Index side : {1, 4})
      for (const RowStrategy strategy : {RowStrategy::group, RowStrategy::invocation})
        for (const Index columns : {1, 3, 6}) {
          const auto matrix = random_sparse<Scalar>(203, 150, side, 0.2);
          ASSERT_EQ(row_fours(matrix).has_value(), side == 4);
          EXPECT_LE(worst(matrix, CsrOnDevice<Scalar>(device(), matrix, strategy), columns), 1)
              << side << ' ' << columns;
        }
  }
};

TEST_F(SparseOnDevices, MultiplyByRowsAndByFoursOfThemInFloat) {
  expect_right_products<float>();
}

TEST_F(SparseOnDevices, MultiplyByRowsAndByFoursOfThemInDouble) {
  expect_right_products<double>();
}

TEST_F(SparseOnDevices, TakeWideColumns) {
  for (const Index side : {1, 4})
    for (const RowStrategy strategy : {RowStrategy::group, RowStrategy::invocation}) {
      const auto matrix = random_sparse<float>(9, 70000, side, 0.01);
      EXPECT_LE(worst(matrix, CsrOnDevice<float>(device(), matrix, strategy), 2), 1) << side;
    }
}

TEST_F(SparseOnDevices, AreSplitByRowsOverStorageBlocks) {
  for (const Index side : {1, 4}) {
    const auto matrix = random_sparse<float>(203, 150, side, 0.2);
    const CsrOnDevice<float> copy(device_with_blocks_of(4096), matrix, RowStrategy::invocation);
    EXPECT_GT(copy.blocks(), 5U);
    EXPECT_LE(worst(matrix, copy, 3), 1) << side;
  }
}

}  // namespace
}  // namespace radiosity

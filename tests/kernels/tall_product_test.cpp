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

}  // namespace
}  // namespace radiosity

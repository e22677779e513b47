#include "foundation/error.hpp"
#include "kernels/tall_matrix.hpp"
#include "product_reference.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace radiosity {
namespace {

template <typename Scalar>
class TallMatrixStorage : public testing::Test {};
using TallMatrixTypes = testing::Types<double, float>;
TYPED_TEST_SUITE(TallMatrixStorage, TallMatrixTypes);

TYPED_TEST(TallMatrixStorage, KeepsEntriesWithinTheTypesRoundoff) {
  const Eigen::MatrixXd matrix = 1e30 * random_matrix(130, 9, 61);
  const TallMatrix<TypeParam> M(matrix);
  const double underflow = underflow_error<TypeParam>() * M.scale();
  for (Index p = 0; p < 9; ++p)
    for (Index e = 0; e < 130; ++e)
      EXPECT_LE(std::fabs(M(e, p) - matrix(e, p)),
                std::max(unit_roundoff<TypeParam>() * std::fabs(matrix(e, p)), underflow));
}

TYPED_TEST(TallMatrixStorage, PadsTheLastPanelOnlyWithZeros) {
  const TallMatrix<TypeParam> M(Eigen::MatrixXd::Ones(65, 3));
  EXPECT_EQ(M.panels(), 2);
  EXPECT_EQ(M.entry_bytes(), 2u * 64u * 3u * sizeof(TypeParam));
  EXPECT_EQ(M.panel(1), M.panel(0) + 64 * 3);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(M.panel(1)) % 64, 0u);
  for (Index p = 0; p < 3; ++p) {
    EXPECT_EQ(M.scale() * static_cast<double>(M.panel(1)[64 * p]), 1);
    for (Index i = 1; i < 64; ++i) EXPECT_EQ(M.panel(1)[64 * p + i], 0);
  }
}

TYPED_TEST(TallMatrixStorage, IsClonedWithItsScale) {
  TallMatrix<TypeParam> M(1e-30 * random_matrix(70, 3, 63));
  const TallMatrix<TypeParam> copy = M.clone();
  EXPECT_EQ(copy.scale(), M.scale());
  for (Index p = 0; p < 3; ++p)
    for (Index e = 0; e < 70; ++e) EXPECT_EQ(copy(e, p), M(e, p));
  const double before = copy(69, 2);
  M.set(69, 2, 0);
  EXPECT_EQ(copy(69, 2), before);
}

TYPED_TEST(TallMatrixStorage, IsFilledByPanelsAndByEntries) {
  const Eigen::MatrixXd matrix = random_matrix(150, 5, 62);
  const TallMatrix<TypeParam> whole(matrix);
  TallMatrix<TypeParam> by_panels(150, 5, whole.scale());
  TallMatrix<TypeParam> by_entries(150, 5, whole.scale());
  for (Index b = 0; b < 3; ++b)
    by_panels.fill_panel(b, matrix.middleRows(64 * b, std::min<Index>(64, 150 - 64 * b)));
  for (Index p = 0; p < 5; ++p)
    for (Index e = 0; e < 150; ++e) {
      EXPECT_EQ(by_entries(e, p), 0);
      by_entries.set(e, p, matrix(e, p));
      EXPECT_EQ(by_panels(e, p), whole(e, p));
      EXPECT_EQ(by_entries(e, p), whole(e, p));
    }
}

TYPED_TEST(TallMatrixStorage, RefusesWhatItCannotHold) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(TallMatrix<TypeParam>(-1, 3), UsageError);
  for (const double scale : {0.0, -2.0, 3.0, infinity, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(TallMatrix<TypeParam>(4, 3, scale), UsageError) << scale;
  EXPECT_THROW(TallMatrix<TypeParam>(Eigen::MatrixXd::Constant(2, 2, infinity)), Error);
  TallMatrix<TypeParam> M(70, 3);
  EXPECT_THROW(M.set(0, 0, infinity), Error);
  EXPECT_THROW(M.fill_panel(0, Eigen::MatrixXd::Zero(6, 3)), UsageError);
  EXPECT_THROW(M.fill_panel(1, Eigen::MatrixXd::Zero(6, 4)), UsageError);
  EXPECT_THROW(M.fill_panel(2, Eigen::MatrixXd::Zero(6, 3)), UsageError);
  EXPECT_THROW(M.fill_panel(-1, Eigen::MatrixXd::Zero(64, 3)), UsageError);
}

TEST(TallMatrix, RefusesFloatEntriesBeyondItsScale) {
  TallMatrix<float> M(1, 1);
  EXPECT_THROW(M.set(0, 0, 1e39), Error);
  TallMatrix<float> scaled(1, 1, storage_scale<float>(1e39));
  scaled.set(0, 0, 1e39);
  EXPECT_NEAR(scaled(0, 0), 1e39, 1e32);
}

}  // namespace
}  // namespace radiosity

#include "foundation/error.hpp"
#include "kernels/row_major_matrix.hpp"
#include "kernels/symmetric_tiles.hpp"
#include "product_reference.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace radiosity {
namespace {

template <typename Scalar>
class SymmetricTilesOf : public testing::Test {};
TYPED_TEST_SUITE(SymmetricTilesOf, StorageTypes);

TYPED_TEST(SymmetricTilesOf, StartZeroAndAlignedWithThePresentTilesOnly) {
  const SymmetricTiles<TypeParam> tiles(200, [](Index I, Index J) { return J != I + 1; });
  EXPECT_EQ(tiles.tile_rows(), 4);
  EXPECT_EQ(tiles.tile_count(), 7);
  EXPECT_EQ(tiles.find_tile(0, 0), 0);
  EXPECT_EQ(tiles.find_tile(0, 1), -1);
  EXPECT_EQ(tiles.find_tile(1, 3), 4);
  EXPECT_EQ(tiles.tile_column(4), 3);
  EXPECT_EQ(materialize(tiles), Eigen::MatrixXd::Zero(200, 200));
  EXPECT_EQ(tiles.entry_bytes(), 7 * 4096 * sizeof(TypeParam));
  EXPECT_EQ(tiles.directory_bytes(), 5 * sizeof(Index) + 7 * sizeof(std::int32_t));
  for (Index tile = 0; tile < tiles.tile_count(); ++tile)
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(tiles.tile_data(tile)) % 64, 0u);
}

TYPED_TEST(SymmetricTilesOf, SetsBothHalvesAndRefusesWhatIsNotKept) {
  SymmetricTiles<TypeParam> tiles(130, [](Index I, Index J) { return I == J || J == 2; });
  tiles.set(3, 5, round_to<TypeParam>(2.0));
  tiles.set(129, 70, round_to<TypeParam>(3.0));
  EXPECT_EQ(tiles(5, 3), 2);
  EXPECT_EQ(tiles(3, 5), 2);
  EXPECT_EQ(tiles(70, 129), 3);
  EXPECT_EQ(tiles(129, 70), 3);
  EXPECT_EQ(tiles(0, 70), 0);
  EXPECT_THROW(tiles.set(0, 70, TypeParam{}), std::out_of_range);
  EXPECT_THROW(tiles.set(0, 130, TypeParam{}), std::out_of_range);
  EXPECT_THROW(tiles.set(-1, 4, TypeParam{}), std::out_of_range);
}

TYPED_TEST(SymmetricTilesOf, ConvertRoundsEachEntryOnce) {
  const Eigen::MatrixXd matrix = 1e-7 * random_symmetric_matrix(100, 41);
  const auto tiles = convert<TypeParam>(tiles_of(matrix));
  const double underflow = underflow_error<TypeParam>() * tiles.scale();
  for (Index j = 0; j < 100; ++j)
    for (Index i = 0; i < 100; ++i)
      EXPECT_LE(std::fabs(tiles(i, j) - matrix(i, j)),
                std::max(unit_roundoff<TypeParam>() * std::fabs(matrix(i, j)), underflow));
  EXPECT_EQ(materialize(convert<double>(tiles)), materialize(tiles));
}

TYPED_TEST(SymmetricTilesOf, WithoutZeroTilesKeepsTheMatrix) {
  Eigen::MatrixXd matrix = random_symmetric_matrix(250, 42);
  matrix.block(64, 128, 64, 64).setZero();
  matrix.block(128, 64, 64, 64).setZero();
  const auto tiles = convert<TypeParam>(tiles_of(matrix));
  const auto smaller = tiles.without_zero_tiles();
  EXPECT_EQ(smaller.tile_count(), tiles.tile_count() - 1);
  EXPECT_EQ(smaller.scale(), tiles.scale());
  EXPECT_EQ(materialize(smaller), materialize(tiles));
}

TYPED_TEST(SymmetricTilesOf, ExistWithoutRows) {
  const SymmetricTiles<TypeParam> tiles(0, [](Index, Index) { return true; });
  EXPECT_EQ(tiles.tile_count(), 0);
  EXPECT_EQ(tiles.entry_bytes(), 0u);
  EXPECT_EQ(convert<Half>(tiles).size(), 0);
  EXPECT_EQ(materialize(tiles).size(), 0);
}

// binary16 has five exponent bits: without its scale, form factors below 6e-5 would lose digits.
TEST(SymmetricTiles, HalfKeepsDigitsOfSmallEntries) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Constant(2, 2, 0.2);
  matrix(1, 1) = 0.2 * 2.1e-9;
  const auto tiles = convert<Half>(tiles_of(matrix));
  EXPECT_NEAR(tiles(1, 1), matrix(1, 1), unit_roundoff<Half>() * matrix(1, 1));
  EXPECT_NEAR(tiles(0, 1), 0.2, unit_roundoff<Half>() * 0.2);
}

TEST(SymmetricTiles, ConvertRefusesEntriesThatAreNotFinite) {
  for (const double wrong :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Ones(3, 3);
    matrix(2, 2) = wrong;
    EXPECT_THROW(convert<Half>(tiles_of(matrix)), Error);
    EXPECT_THROW(RowMajorMatrix<float>{matrix}, Error);
  }
}

}  // namespace
}  // namespace radiosity

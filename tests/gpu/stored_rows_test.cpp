#include "gpu/stored_rows.hpp"
#include "tests/gpu/device_test.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace radiosity {
namespace {

using Rows = DeviceTest;

/// 10 rows of 8 bytes: row r holds r twice.
StoredRows ten_rows(std::int64_t block_bytes, Index together) {
  const auto device = GlDevice::open({.debug = true, .storage_block_bytes = block_bytes});
  const CurrentContext current(*device->context());
  std::vector<std::int32_t> row(2);
  const RowsToStore shape{.rows = 10, .row_bytes = 8, .subject = "a row takes", .together = together};
  return {device->context(), shape, [&](Index r) {
            std::fill(row.begin(), row.end(), static_cast<std::int32_t>(r));
            return row.data();
          }};
}

TEST_F(Rows, AreCutIntoPartsThatFitAndKeepTheirNumbers) {
  const StoredRows rows = ten_rows(31, 1);  // three rows and some bytes
  ASSERT_EQ(rows.parts().size(), 4U);
  EXPECT_EQ(rows.bytes(), 80U);
  Index next = 0;
  for (const StoredRows::Part& part : rows.parts()) {
    EXPECT_EQ(part.first_row, next);
    EXPECT_LE(part.buffer.bytes(), 31U);
    next += part.rows;
  }
  EXPECT_EQ(next, 10);
}

TEST_F(Rows, StayTogetherInMultiplesWhereThatFits) {
  EXPECT_EQ(ten_rows(8 * 7, 4).parts().front().rows, 4);
  EXPECT_EQ(ten_rows(8 * 3, 4).parts().front().rows, 3) << "a multiple of four is too much";
}

TEST_F(Rows, ThatDoNotFitAreRefusedInASentence) {
  try {
    ten_rows(7, 1);
    FAIL() << "it was not refused";
  } catch (const Error& error) {
    for (const char* part : {"a row takes 8 bytes", "at most 7", "--device cpu"})
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace radiosity

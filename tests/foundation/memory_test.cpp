#include "foundation/error.hpp"
#include "foundation/memory.hpp"

#include <gtest/gtest.h>

namespace radiosity {
namespace {

TEST(Memory, IsRefusedInASentenceBeforeItIsTaken) {
  EXPECT_NO_THROW(require_available_memory("a small matrix", 1));
  try {
    require_available_memory("a matrix of 1e9 patches", 8e18, "take a smaller one");
    FAIL() << "8 EB were granted";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find("a matrix of 1e9 patches takes about 8 EB of memory, and "), 0U) << text;
    EXPECT_NE(text.find(" are free: take a smaller one"), std::string::npos) << text;
  }
}

TEST(Memory, OfTheMachineBoundsWhatIsFree) {
  EXPECT_GT(available_memory(), 0);
  EXPECT_LE(available_memory(), machine_memory());
}

TEST(Memory, IsToldInUnitsOfAThousand) {
  EXPECT_EQ(byte_text(999), "999 bytes");
  EXPECT_EQ(byte_text(48.1e6), "48.1 MB");
  EXPECT_EQ(byte_text(3.214e9), "3.21 GB");
}

}  // namespace
}  // namespace radiosity

#include "foundation/error.hpp"
#include "kernels/instruction_set.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>

namespace radiosity {
namespace {

/// Sets RADIOSITY_INSTRUCTIONS while it lives and puts back what was there.
class Environment {
 public:
  explicit Environment(const char* value) {
    if (const char* old = std::getenv(variable)) old_ = old;
    setenv(variable, value, 1);
  }
  ~Environment() {
    if (old_)
      setenv(variable, old_->c_str(), 1);
    else
      unsetenv(variable);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  static constexpr const char* variable = "RADIOSITY_INSTRUCTIONS";
  std::optional<std::string> old_;
};

TEST(InstructionSet, RisesFromBaseline) {
  const auto sets = available_instruction_sets();
  ASSERT_FALSE(sets.empty());
  EXPECT_EQ(sets.front(), InstructionSet::baseline);
  for (std::size_t k = 1; k < sets.size(); ++k) EXPECT_LT(sets[k - 1], sets[k]);
}

TEST(InstructionSet, TheEnvironmentLowersItAndNeverRaisesIt) {
  const InstructionSet best = available_instruction_sets().back();
  {
    const Environment lowered("baseline");
    EXPECT_EQ(best_instruction_set(), InstructionSet::baseline);
  }
  const Environment highest("avx512");
  EXPECT_EQ(best_instruction_set(), best);
}

TEST(InstructionSet, AnUnknownNameIsAnErrorThatListsTheKnownOnes) {
  const Environment wrong("sse9");
  try {
    best_instruction_set();
    FAIL() << "accepted";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("sse9"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("baseline, avx2 or avx512"), std::string::npos);
  }
}

}  // namespace
}  // namespace radiosity

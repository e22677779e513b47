#include "foundation/hash.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>

namespace radiosity {
namespace {

template <typename... Values>
std::uint64_t hash_of(const Values&... values) {
  Fingerprint print;
  (print.add(values), ...);
  return print.value();
}

TEST(Fingerprint, TellsValuesOrdersAndLengthsApart) {
  const std::set<std::uint64_t> prints = {hash_of(),
                                          hash_of(0.0),
                                          hash_of(1.0),
                                          hash_of(1.0, 2.0),
                                          hash_of(2.0, 1.0),
                                          hash_of(std::string_view("ab")),
                                          hash_of(std::string_view("a"), std::string_view("b")),
                                          hash_of(1.0 + 1e-16 * 3)};
  EXPECT_EQ(prints.size(), 8U);
}

TEST(Fingerprint, TakesBothZerosForOne) {
  EXPECT_EQ(hash_of(0.0), hash_of(-0.0));
}

}  // namespace
}  // namespace radiosity

#pragma once

#include <array>
#include <cstdint>

namespace radiosity {

/// The first four dimensions of Sobol's sequence (direction numbers of Joe and Kuo, 2008) as 32-bit
/// fractions. Points 16 k ... 16 k + 15 form a net, so that even one packet of rays is spread evenly over
/// both patches.
class SobolPoints {
 public:
  static constexpr int dimensions = 4;

  SobolPoints() {
    constexpr std::array<std::array<std::uint32_t, 3>, dimensions> initial = {
        {{1, 1, 1}, {1, 0, 0}, {1, 3, 0}, {1, 3, 1}}};
    constexpr std::array<int, dimensions> degree = {0, 1, 2, 3};
    constexpr std::array<std::uint32_t, dimensions> polynomial = {0, 0, 1, 1};
    for (std::size_t d = 0; d < dimensions; ++d) {
      std::array<std::uint32_t, 32> m{};
      const auto s = static_cast<std::size_t>(degree[d]);
      for (std::size_t k = 0; k < 32; ++k) {
        if (s == 0) {
          m[k] = 1;
        } else if (k < s) {
          m[k] = initial[d][k];
        } else {
          m[k] = m[k - s] ^ (m[k - s] << s);
          for (std::size_t j = 1; j < s; ++j)
            if ((polynomial[d] >> (s - 1 - j)) & 1U) m[k] ^= m[k - j] << j;
        }
        direction_[d][k] = m[k] << (31 - k);
      }
    }
  }

  std::uint32_t operator()(int dimension, std::uint32_t index) const {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; index != 0; ++k, index >>= 1)
      if (index & 1U) bits ^= direction_[static_cast<std::size_t>(dimension)][k];
    return bits;
  }

 private:
  std::array<std::array<std::uint32_t, 32>, dimensions> direction_;
};

}  // namespace radiosity

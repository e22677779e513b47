#pragma once

#include "compression/level_fit.hpp"
#include "foundation/random.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace radiosity {

struct BlockPattern {
  std::string name;
  Texels code;
};

/// What a block of codes may look like (hard case C1).
inline std::vector<BlockPattern> block_patterns() {
  RandomStream random(5);
  const Texels ramp = Texels::LinSpaced(0, 15);
  const Texels noise = Texels::NullaryExpr([&] { return static_cast<float>(random.uniform(0, 255)); });
  Texels spike = Texels::Constant(3);
  spike[6] = 250;
  const Texels mask = (noise > 100).cast<float>();
  return {{"zeros", Texels::Zero()},
          {"constant", Texels::Constant(100.3F)},
          {"one", Texels::Ones()},
          {"full", Texels::Constant(255)},
          {"ramp", 17 * ramp},
          {"slow ramp", 90 + ramp / 4},
          {"spike", spike},
          {"noise", noise},
          {"mask of ones", mask},
          {"mask of 255", 255 * mask},
          {"subnormals", 1e-41F * ramp}};
}

/// A smooth field with noise, codes as they are stored: whole numbers.
inline Texels random_codes(RandomStream& random) {
  const double base = random.uniform(30, 225), across = random.uniform(-8, 8), down = random.uniform(-8, 8);
  const double noise = std::exp(random.uniform(-1, 4));
  Texels code;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      code[4 * row + column] =
          static_cast<float>(base + across * column + down * row + random.uniform(-noise, noise));
  return code.max(0).min(255).round();
}

}  // namespace radiosity

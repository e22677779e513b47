#pragma once

#include <cmath>
#include <numbers>
#include <vector>

namespace radiosity {

/// Nodes in (-1, 1) and weights (sum 2) of the Gauss-Legendre rule with `count` points: exact to degree 2
/// count - 1.
struct GaussLegendre {
  std::vector<double> node;
  std::vector<double> weight;

  explicit GaussLegendre(int count) {
    for (int i = 0; i < count; ++i) {
      double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
      double derivative = 1;
      for (int iteration = 0; iteration < 100; ++iteration) {
        double previous = 1, value = x;
        for (int k = 2; k <= count; ++k) {
          const double following = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
          previous = value;
          value = following;
        }
        derivative = count * (x * value - previous) / (x * x - 1);
        const double step = value / derivative;
        x -= step;
        if (std::abs(step) < 1e-16) break;
      }
      node.push_back(x);
      weight.push_back(2 / ((1 - x * x) * derivative * derivative));
    }
  }
};

}  // namespace radiosity

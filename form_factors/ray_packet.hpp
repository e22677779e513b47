#pragma once

#include <cstdint>

namespace radiosity {

/// Sixteen segments between surfaces of the scaled scene, float32.
struct RayPacket {
  static constexpr int size = 16;
  alignas(64) float origin_x[size];
  alignas(64) float origin_y[size];
  alignas(64) float origin_z[size];
  alignas(64) float target_x[size];
  alignas(64) float target_y[size];
  alignas(64) float target_z[size];
  alignas(64) std::int32_t active[size];   ///< -1: trace, 0: leave out
  alignas(64) std::int32_t blocked[size];  ///< 1 where something stands in between
};

}  // namespace radiosity

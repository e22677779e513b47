#include "kernels/tile_products.hpp"

#include <cstdint>
#include <cstring>

namespace radiosity {
namespace {

/// Plain arithmetic on short arrays, which a compiler turns into whatever every processor of the target has.
template <typename Number>
struct Lanes {
  static constexpr int width = 4;
  struct Vector {
    Number lane[width];
  };

  static Vector zero() { return broadcast(0); }
  static Vector broadcast(Number number) { return {{number, number, number, number}}; }
  static Vector load(const Number* from) {
    Vector result;
    std::memcpy(&result, from, sizeof result);
    return result;
  }
  static Vector load(const Half* from) {
    Vector result;
    for (int k = 0; k < width; ++k) result.lane[k] = stored_half(from[k]);
    return result;
  }
  static void store(Number* to, const Vector& vector) { std::memcpy(to, &vector, sizeof vector); }
  static Vector multiply_add(const Vector& a, const Vector& b, const Vector& c) {
    Vector result;
    for (int k = 0; k < width; ++k) result.lane[k] = a.lane[k] * b.lane[k] + c.lane[k];
    return result;
  }
  static void row_sums(const Number* lanes, Number* sums) {
    for (int r = 0; r < width; ++r) {
      const Number* row = lanes + r * width;
      sums[r] = (row[0] + row[1]) + (row[2] + row[3]);
    }
  }

  /// to_float without its branch: stored matrices hold no infinity and no NaN.
  static float stored_half(Half half) {
    const std::uint32_t sign = static_cast<std::uint32_t>(half.bits & 0x8000) << 16;
    std::uint32_t word = static_cast<std::uint32_t>(half.bits & 0x7fff) << 13;
    float value;
    std::memcpy(&value, &word, sizeof value);
    value *= 0x1p112f;
    std::memcpy(&word, &value, sizeof word);
    word |= sign;
    std::memcpy(&value, &word, sizeof value);
    return value;
  }
};

template <typename Number, int columns>
constexpr int strip_vectors = 2;

}  // namespace
}  // namespace radiosity

#include "kernels/tile_products.inl"

namespace radiosity {

void get_baseline_products(TileProducts<double>& f64, TileProducts<float>& f32, TileProducts<Half>& f16) {
  get_products(f64);
  get_products(f32);
  get_products(f16);
}

}  // namespace radiosity

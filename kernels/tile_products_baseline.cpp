#include "kernels/tile_products.hpp"

#include <cstdint>
#include <cstring>

namespace radiosity {
namespace {

// Vectors of 16 bytes in the language extension that GCC and Clang share: whatever every processor of the
// target has.
template <typename Number>
struct Sixteen {
  typedef Number Bytes __attribute__((vector_size(16)));
};

template <typename Number>
struct Lanes {
  static constexpr int width = 16 / static_cast<int>(sizeof(Number));
  using Vector = typename Sixteen<Number>::Bytes;

  static Vector zero() { return Vector{}; }
  static Vector broadcast(Number number) { return zero() + number; }
  static Vector load(const Number* from) { return *reinterpret_cast<const Vector*>(from); }
  static void store(Number* to, Vector vector) { *reinterpret_cast<Vector*>(to) = vector; }
  static Vector multiply_add(Vector a, Vector b, Vector c) { return a * b + c; }
  static void add_scaled(double* y, Vector vector, double scale) {
    for (int k = 0; k < width; ++k) y[k] += scale * static_cast<double>(vector[k]);
  }
  static Vector row_sums(const Number* lanes) {
    Vector sums;
    for (int r = 0; r < width; ++r) {
      const Number* row = lanes + r * width;
      sums[r] = width == 2 ? row[0] + row[1] : (row[0] + row[1]) + (row[width - 2] + row[width - 1]);
    }
    return sums;
  }

  /// to_float without its branch: stored matrices hold no infinity and no NaN.
  static Vector load(const Half* from) {
    using Words = typename Sixteen<std::uint32_t>::Bytes;
    typedef std::uint16_t Halves __attribute__((vector_size(8)));
    Halves halves;
    std::memcpy(&halves, from, sizeof halves);
    const Words words = __builtin_convertvector(halves, Words);
    const Vector magnitude = reinterpret_cast<Vector>((words & 0x7fffu) << 13) * 0x1p112f;
    return reinterpret_cast<Vector>(reinterpret_cast<Words>(magnitude) | ((words & 0x8000u) << 16));
  }
};

template <typename Number, int columns>
constexpr int strip_vectors = columns == 1 ? 4 : 2;

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

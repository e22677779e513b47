#include "kernels/tile_products.hpp"

#include <tuple>

namespace radiosity {
namespace {

using AllProducts = std::tuple<TileProducts<double>, TileProducts<float>, TileProducts<Half>>;

AllProducts all_products(InstructionSet instructions) {
  AllProducts all;
  auto& [f64, f32, f16] = all;
#if defined(RADIOSITY_X86_KERNELS)
  if (instructions == InstructionSet::avx512) {
    get_avx512_products(f64, f32, f16);
    return all;
  }
  if (instructions == InstructionSet::avx2) {
    get_avx2_products(f64, f32, f16);
    return all;
  }
#endif
  static_cast<void>(instructions);
  get_baseline_products(f64, f32, f16);
  return all;
}

}  // namespace

template <typename Scalar>
TileProducts<Scalar> tile_products(InstructionSet instructions) {
  return std::get<TileProducts<Scalar>>(all_products(instructions));
}

TileProducts<Bc4Block> bc4_products(InstructionSet instructions, const TileCurve& curve) {
  TileProducts<Bc4Block> linear;
  TileProducts<Bc4Block> logarithmic;
#if defined(RADIOSITY_X86_KERNELS)
  if (instructions == InstructionSet::avx512) get_avx512_products(linear, logarithmic);
#endif
  static_cast<void>(instructions);
  return curve.logarithmic ? logarithmic : linear;
}

template TileProducts<double> tile_products(InstructionSet);
template TileProducts<float> tile_products(InstructionSet);
template TileProducts<Half> tile_products(InstructionSet);

}  // namespace radiosity

#include "gpu/texture_palettes.hpp"
#include "tests/gpu/device_test.hpp"

namespace radiosity {
namespace {

using Palettes = DeviceTest;

ColourTexture black_texture(int channels, double range) {
  return {8, 8, channels, {.logarithmic = true, .range = range}};
}

TEST_F(Palettes, AreThereOnceForTexturesOfOneCurve) {
  const CurrentContext current(*device()->context());
  TexturePalettes palettes(device()->context());
  const auto first = palettes.of(black_texture(3, 25));
  EXPECT_EQ(first->bytes(), (2 * 32 * 32 + 64 * 64) * 4 * sizeof(float));
  const GlTraffic before = device()->context()->traffic();
  EXPECT_EQ(palettes.of(black_texture(3, 25)), first);
  EXPECT_EQ(device()->context()->traffic().sendings, before.sendings);
  EXPECT_NE(palettes.of(black_texture(3, 20)), first);
  EXPECT_NE(palettes.of(black_texture(1, 25)), first);
}

TEST_F(Palettes, GoWithTheLastTextureThatReadsThem) {
  const CurrentContext current(*device()->context());
  TexturePalettes palettes(device()->context());
  std::weak_ptr<const GlBuffer> seen;
  {
    const auto first = palettes.of(black_texture(1, 25));
    seen = first;
  }
  EXPECT_TRUE(seen.expired());
  EXPECT_EQ(palettes.of(black_texture(1, 25))->bytes(), 64 * 64 * 4 * sizeof(float));
}

}  // namespace
}  // namespace radiosity

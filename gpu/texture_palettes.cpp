#include "gpu/texture_palettes.hpp"

#include "kernels/texture_products.hpp"

namespace radiosity {
namespace {

/// What ColourTexture says.
void append_palettes(const float* table, int largest, std::vector<float>& palettes) {
  for (int second = 0; second <= largest; ++second)
    for (int first = 0; first <= largest; ++first) {
      const float A = table[first];
      const float B = table[second];
      const bool none = first == 0 && second == 0;
      for (const float number : {first == 0 ? 0 : A * A * A, second == 0 ? 0 : B * B * B,
                                 none ? 0 : A * A * B, none ? 0 : A * (B * B)})
        palettes.push_back(number);
    }
}

GlBuffer send_palettes(const std::shared_ptr<const GlContext>& context, const ColourTexture& texture) {
  std::vector<float> palettes;
  for (int channel = 0; channel < texture.channels(); ++channel) {
    const int colour = texture.colour_channel(channel);
    append_palettes(texture.tables() + colour * texture_table, bc1_largest(colour), palettes);
  }
  GlBuffer buffer(context, palettes.size() * sizeof(float));
  buffer.write(0, buffer.bytes(), palettes.data());
  return buffer;
}

}  // namespace

std::shared_ptr<const GlBuffer> TexturePalettes::of(const ColourTexture& texture) {
  std::erase_if(known_, [](const Known& known) { return known.palettes.expired(); });
  for (const Known& known : known_) {
    auto palettes = known.palettes.lock();
    if (palettes != nullptr && known.range == texture.curve().range && known.channels == texture.channels())
      return palettes;
  }
  auto palettes = std::make_shared<const GlBuffer>(send_palettes(context_, texture));
  known_.push_back({texture.curve().range, texture.channels(), palettes});
  return palettes;
}

}  // namespace radiosity

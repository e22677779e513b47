#include "gpu/sampled_texture_on_device.hpp"

#include "gpu/texture_on_device.hpp"

#include <array>
#include <epoxy/gl.h>

namespace radiosity {
namespace {

constexpr unsigned curve_binding = 3;
constexpr int invocations_of_sampling_group = 64;

int lanes_of_sampling(RowStrategy strategy) {
  return strategy == RowStrategy::group ? invocations_of_sampling_group : 1;
}

BlockTextures send_blocks(const GlDevice& device, const ColourTexture& texture) {
  const CurrentContext current(*device.context());
  return {device.context(), texture};
}

GlBuffer send_curve(const GlDevice& device, const ColourTexture& texture, double scale) {
  std::array<float, 4> numbers{static_cast<float>(texture.curve().range)};
  for (int channel = 0; channel < texture.channels(); ++channel)
    numbers[static_cast<std::size_t>(channel) + 1] = static_cast<float>(texture.scale(channel) / scale);
  const CurrentContext current(*device.context());
  GlBuffer buffer(device.context(), sizeof numbers);
  buffer.write(0, sizeof numbers, numbers.data());
  return buffer;
}

const GlProgram& sampling_program(GlDevice& device, const ColourTexture& texture, RowStrategy strategy) {
  const CurrentContext current(*device.context());
  return device.program({"texture_sampled.comp",
                         {{"CHANNELS", texture.channels()},
                          {"LOGARITHMIC", texture.curve().logarithmic ? 1 : 0},
                          {"INVOCATIONS", invocations_of_sampling_group},
                          {"LANES", lanes_of_sampling(strategy)}}});
}

}  // namespace

SampledTextureOnDevice::SampledTextureOnDevice(const std::shared_ptr<GlDevice>& device_of_texture,
                                               const ColourTexture& texture,
                                               const std::vector<ExactRows>& exact, RowStrategy strategy)
    : TexelsOnDevice(device_of_texture, texture.rows(), texture.columns(), kept_apart_of(texture, exact),
                     strategy),
      block_columns_(texture.block_columns()),
      textures_(send_blocks(*device_of_texture, texture)),
      curve_(send_curve(*device_of_texture, texture, scale())),
      program_(&sampling_program(*device_of_texture, texture, strategy)) {}

void SampledTextureOnDevice::dispatch_texels(Index columns) const {
  for (const BlockTextures::Part& part : textures_.parts())
    for (Index first = 0; first < columns; first += channels()) dispatch_part(part, first);
}

void SampledTextureOnDevice::dispatch_part(const BlockTextures::Part& part, Index first_column) const {
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, part.texture->get());
  curve_.bind(curve_binding);
  const Index rows_together = invocations_of_sampling_group / lanes_of_sampling(strategy());
  program_->use();
  program_->set("blocks_across", textures_.blocks_across());
  dispatch_block_rows(
      *program_, {part.first_row, part.rows, rows_together, block_columns_, FieldBuffers::padded(rows())},
      first_column);
}

}  // namespace radiosity

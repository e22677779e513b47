#include "gpu/texture_on_device.hpp"

#include "kernels/stored_number.hpp"
#include "kernels/texture_products.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace radiosity {
namespace {

/// Of storage blocks and of texture units.
constexpr unsigned blocks_binding = 0;
constexpr unsigned tables_binding = 3;
constexpr unsigned field_unit = 1;
constexpr unsigned palettes_unit = 2;
constexpr int invocations_of_texture_group = 64;
constexpr std::size_t table_numbers = std::size_t{3} * texture_table;

/// Rows of blocks that share what is read of X by texels: more of one channel, which has fewer sums.
int block_rows_of_vector(Index channels) {
  return channels == 1 ? 8 : 4;
}

ShaderVariant shader_for(const ColourTexture& texture, RowStrategy strategy) {
  ShaderVariant variant{
      "texture_texels.comp",
      {{"CHANNELS", texture.channels()}, {"LOGARITHMIC", texture.curve().logarithmic ? 1 : 0}}};
  if (strategy == RowStrategy::group) {
    variant.file = "texture_product.comp";
    variant.defines.emplace_back("INVOCATIONS", invocations_of_texture_group);
  } else {
    variant.defines.emplace_back("ROWS", block_rows_of_vector(texture.channels()));
  }
  return variant;
}

StoredRows rows_of_blocks(const std::shared_ptr<const GlContext>& context, const ColourTexture& texture) {
  const CurrentContext current(*context);
  const Index row_bytes = texture.block_columns() * static_cast<Index>(sizeof(Bc1Block));
  return {context,
          {.rows = texture.block_rows(), .row_bytes = row_bytes, .subject = "a row of blocks takes"},
          [&](Index row) { return texture.block_row(row); }};
}

GlBuffer empty_tables(const std::shared_ptr<const GlContext>& context) {
  const CurrentContext current(*context);
  return {context, (table_numbers + 3) * sizeof(float)};
}

}  // namespace

KeptApart kept_apart_of(const ColourTexture& texture, const std::vector<ExactRows>& exact) {
  double largest = 0;
  for (int channel = 0; channel < texture.channels(); ++channel)
    largest = std::max(largest, std::fabs(texture.scale(channel)));
  KeptApart result;
  for (const ExactRows& rows : exact) {
    result.channels.push_back(rows.compressed_rows());
    for (const float value : result.channels.back().value)
      largest = std::max(largest, std::fabs(static_cast<double>(value)));
  }
  result.scale = storage_scale<float>(largest);
  for (CsrMatrix<float>& matrix : result.channels)
    for (float& value : matrix.value)  // a power of two: nothing is lost
      value = static_cast<float>(static_cast<double>(value) / result.scale);
  return result;
}

void dispatch_block_rows(const GlProgram& program, const BlockRows& rows, Index first_column) {
  program.set("block_columns", rows.columns);
  program.set("first_block_row", rows.first);
  program.set("part_block_rows", rows.count);
  program.set("y_stride", rows.y_stride);
  program.set("first_column", first_column);
  program.dispatch((rows.count + rows.together - 1) / rows.together);
}

TextureOnDevice::TextureOnDevice(const std::shared_ptr<GlDevice>& device, const ColourTexture& texture,
                                 const std::vector<ExactRows>& exact, RowStrategy strategy)
    : TextureOnDevice(device, texture, kept_apart_of(texture, exact), strategy) {}

TextureOnDevice::TextureOnDevice(const std::shared_ptr<GlDevice>& device_of_texture,
                                 const ColourTexture& texture, const KeptApart& kept_apart,
                                 RowStrategy strategy)
    : TexelsOnDevice(device_of_texture, texture.rows(), texture.columns(), kept_apart, strategy),
      block_columns_(texture.block_columns()),
      blocks_(rows_of_blocks(device_of_texture->context(), texture)),
      tables_(empty_tables(device_of_texture->context())) {
  const CurrentContext current(*device().context());
  upload_tables(texture);
  if (strategy == RowStrategy::invocation && texture.curve().logarithmic)
    palettes_ = device().palettes().of(texture);
  program_ = &device().program(shader_for(texture, strategy));
}

void TextureOnDevice::upload_tables(const ColourTexture& texture) {
  std::array<float, table_numbers + 3> numbers{};
  std::copy_n(texture.tables(), table_numbers, numbers.begin());
  for (int channel = 0; channel < texture.channels(); ++channel)
    numbers[table_numbers + static_cast<std::size_t>(channel)] =
        static_cast<float>(texture.scale(channel) / scale());
  tables_.write(0, sizeof numbers, numbers.data());
}

std::size_t TextureOnDevice::texel_bytes() const {
  return tables_.bytes() + (palettes_ != nullptr ? palettes_->bytes() : 0) + blocks_.bytes();
}

void TextureOnDevice::dispatch_texels(Index columns) const {
  if (strategy() == RowStrategy::invocation)
    device().texels().show_bound(field_unit, Texel::four_floats, FieldBuffers::x_binding);
  if (palettes_ != nullptr) device().texels().show(palettes_unit, Texel::four_floats, *palettes_);
  for (const StoredRows::Part& part : blocks_.parts())
    for (Index first = 0; first < columns; first += channels()) dispatch_part(part, first);
}

void TextureOnDevice::dispatch_part(const StoredRows::Part& part, Index first_column) const {
  const bool by_texels = strategy() == RowStrategy::invocation;
  if (by_texels)
    device().texels().show(blocks_binding, Texel::four_words, part.buffer);
  else
    part.buffer.bind(blocks_binding);
  tables_.bind(tables_binding);
  const Index rows_together = by_texels ? block_rows_of_vector(channels()) : 1;
  program_->use();
  dispatch_block_rows(
      *program_, {part.first_row, part.rows, rows_together, block_columns_, FieldBuffers::padded(rows())},
      first_column);
}

}  // namespace radiosity

#include "gpu/texture_on_device.hpp"

#include "kernels/stored_number.hpp"
#include "kernels/texture_products.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace radiosity {
namespace {

constexpr unsigned blocks_binding = 0;
constexpr unsigned tables_binding = 3;
constexpr int invocations_of_texture_group = 64;
constexpr std::size_t table_numbers = std::size_t{3} * texture_table;

/// Invocations that share a row of blocks.
int lanes_of(RowStrategy strategy) {
  return strategy == RowStrategy::group ? invocations_of_texture_group : 1;
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
  program_ = &device().program({"texture_product.comp",
                                {{"CHANNELS", texture.channels()},
                                 {"LOGARITHMIC", texture.curve().logarithmic ? 1 : 0},
                                 {"INVOCATIONS", invocations_of_texture_group},
                                 {"LANES", lanes_of(strategy)}}});
}

void TextureOnDevice::upload_tables(const ColourTexture& texture) {
  std::array<float, table_numbers + 3> numbers{};
  std::copy_n(texture.tables(), table_numbers, numbers.begin());
  for (int channel = 0; channel < texture.channels(); ++channel)
    numbers[table_numbers + static_cast<std::size_t>(channel)] =
        static_cast<float>(texture.scale(channel) / scale());
  tables_.write(0, sizeof numbers, numbers.data());
}

void TextureOnDevice::dispatch_texels(Index columns) const {
  for (const StoredRows::Part& part : blocks_.parts())
    for (Index first = 0; first < columns; first += channels()) dispatch_part(part, first);
}

void TextureOnDevice::dispatch_part(const StoredRows::Part& part, Index first_column) const {
  part.buffer.bind(blocks_binding);
  tables_.bind(tables_binding);
  const Index rows_together = invocations_of_texture_group / lanes_of(strategy());
  const GlProgram& program = *program_;
  program.use();
  program.set("block_columns", block_columns_);
  program.set("first_block_row", part.first_row);
  program.set("part_block_rows", part.rows);
  program.set("y_stride", FieldBuffers::padded(rows()));
  program.set("first_column", first_column);
  program.dispatch((part.rows + rows_together - 1) / rows_together);
}

}  // namespace radiosity

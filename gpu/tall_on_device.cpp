#include "gpu/tall_on_device.hpp"

#include "foundation/error.hpp"

#include <algorithm>

namespace radiosity {
namespace {

constexpr unsigned panels_binding = 0;
constexpr Index panel_rows = TallMatrix<float>::panel_rows;
/// Panels whose sums are put together by one work group: 2048 rows keep the sums of chunks few.
constexpr Index panels_of_chunk = 32;

Index chunks_of(Index panels) {
  return (panels + panels_of_chunk - 1) / panels_of_chunk;
}

}  // namespace

TallOnDevice::TallOnDevice(std::shared_ptr<GlDevice> device, const TallMatrix<float>& matrix, bool ordered)
    : device_(std::move(device)),
      rows_(matrix.rows()),
      columns_(matrix.columns()),
      scale_(matrix.scale()),
      product_("tall_product.comp", {{"ORDERED", ordered ? 1 : 0}}),
      transposed_("tall_transposed.comp", {}) {
  const GlContext& context = *device_->context();
  const CurrentContext current(context);
  const Index panel_bytes = panel_rows * std::max<Index>(columns_, 1) * static_cast<Index>(sizeof(float));
  const std::int64_t limit = context.limits().storage_block_bytes;
  // Whole chunks, unless that is too much.
  Index most = limit / panel_bytes;
  if (most > panels_of_chunk) most -= most % panels_of_chunk;
  if (most == 0)
    fail(
        "{} rows of a factor take {} bytes, and a storage block of '{}' at most {}: use a smaller k or "
        "--device cpu",
        panel_rows, panel_bytes, context.renderer(), limit);
  for (Index first = 0; first < matrix.panels(); first += most) {
    const Index panels = std::min(most, matrix.panels() - first);
    GlBuffer entries(device_->context(), static_cast<std::size_t>(panels * panel_bytes));
    if (columns_ > 0) entries.write(0, entries.bytes(), matrix.panel(first));
    blocks_.push_back({first, panels, std::move(entries)});
  }
  context.check("sending a factor");
}

std::size_t TallOnDevice::bytes() const {
  std::size_t bytes = 0;
  for (const Block& block : blocks_) bytes += block.entries.bytes();
  return bytes;
}

Index TallOnDevice::chunks() const {
  Index chunks = 0;
  for (const Block& block : blocks_) chunks += chunks_of(block.panels);
  return chunks;
}

void TallOnDevice::multiply(Index columns) const {
  for (const Block& block : blocks_) {
    block.entries.bind(panels_binding);
    product_.for_columns(*device_, columns, [&](const GlProgram& program, Index first_column) {
      program.set("rank", columns_);
      program.set("rows", rows_);
      program.set("first_panel", block.first_panel);
      program.set("block_panels", block.panels);
      program.set("x_stride", FieldBuffers::padded(columns_));
      program.set("y_stride", FieldBuffers::padded(rows_));
      program.set("first_column", first_column);
      program.dispatch(block.panels);
    });
  }
}

void TallOnDevice::multiply_transposed(Index columns) const {
  if (columns_ == 0) return;
  Index first_chunk = 0;
  for (const Block& block : blocks_) {
    block.entries.bind(panels_binding);
    transposed_.for_columns(*device_, columns, [&](const GlProgram& program, Index first_column) {
      program.set("rank", columns_);
      program.set("first_panel", block.first_panel);
      program.set("block_panels", block.panels);
      program.set("panels_of_chunk", panels_of_chunk);
      program.set("first_chunk", first_chunk);
      program.set("columns", columns);
      program.set("x_stride", FieldBuffers::padded(rows_));
      program.set("sum_stride", FieldBuffers::padded(columns_));
      program.set("first_column", first_column);
      program.dispatch(chunks_of(block.panels) * columns_);
    });
    first_chunk += chunks_of(block.panels);
  }
}

}  // namespace radiosity

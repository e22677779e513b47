#include "gpu/tall_on_device.hpp"

#include <type_traits>
#include <utility>

namespace radiosity {
namespace {

/// Of storage blocks and of texture units.
constexpr unsigned panels_binding = 0;
constexpr unsigned vectors_unit = 1;
constexpr unsigned order_binding = 5;
constexpr Index panel_rows = TallMatrix<float>::panel_rows;
/// Panels whose sums are put together by one work group: 2048 rows keep the sums of chunks few.
constexpr Index panels_of_chunk = 32;
/// Where each invocation has columns of its own.
constexpr int columns_of_invocation = 4;
constexpr Index columns_of_vector = Index{8} * columns_of_invocation;

Index chunks_of(Index panels) {
  return (panels + panels_of_chunk - 1) / panels_of_chunk;
}

template <typename Scalar>
StoredRows panels_of(const GlDevice& device, const TallMatrix<Scalar>& matrix) {
  const CurrentContext current(*device.context());
  return {device.context(),
          {.rows = matrix.panels(),
           .row_bytes = panel_rows * matrix.columns() * static_cast<Index>(sizeof(Scalar)),
           .subject = "64 rows of a factor take",
           .remedy = "use a smaller k or --device cpu",
           .together = panels_of_chunk},
          [&](Index panel) { return matrix.panel(panel); }};
}

ShaderFamily product_shaders(bool by_texels, bool in_double, bool ordered) {
  if (by_texels) return {"tall_product_texels.comp", {{"ORDERED", ordered ? 1 : 0}}};
  return {"tall_product.comp", {{"ORDERED", ordered ? 1 : 0}, {"DOUBLE", in_double ? 1 : 0}}};
}

ShaderFamily transposed_shaders(bool by_texels, bool in_double) {
  if (by_texels) return {"tall_transposed_texels.comp", {{"SHARE", columns_of_invocation}}};
  return {"tall_transposed.comp", {{"DOUBLE", in_double ? 1 : 0}}};
}

}  // namespace

template <typename Scalar>
TallOnDevice::TallOnDevice(std::shared_ptr<GlDevice> device, const TallMatrix<Scalar>& matrix,
                           RowStrategy strategy, std::shared_ptr<const GlBuffer> order)
    : device_(std::move(device)),
      rows_(matrix.rows()),
      columns_(matrix.columns()),
      scale_(matrix.scale()),
      in_double_(std::is_same_v<Scalar, double>),
      panels_(panels_of(*device_, matrix)),
      order_(std::move(order)),
      by_texels_(strategy == RowStrategy::invocation && !in_double_),
      columns_of_group_(by_texels_ ? columns_of_vector : 1),
      product_(product_shaders(by_texels_, in_double_, order_ != nullptr)),
      transposed_(transposed_shaders(by_texels_, in_double_)) {}

Index TallOnDevice::chunks() const {
  Index chunks = 0;
  for (const StoredRows::Part& part : panels_.parts()) chunks += chunks_of(part.rows);
  return chunks;
}

void TallOnDevice::bind_vectors() const {
  if (by_texels_) device_->texels().show_bound(vectors_unit, Texel::four_floats, FieldBuffers::x_binding);
}

void TallOnDevice::bind_panels(const StoredRows::Part& part) const {
  if (by_texels_)
    device_->texels().show(panels_binding, Texel::four_floats, part.buffer);
  else
    part.buffer.bind(panels_binding);
}

void TallOnDevice::multiply(Index columns) const {
  bind_vectors();
  if (order_ != nullptr) order_->bind(order_binding);
  for (const StoredRows::Part& part : panels_.parts()) {
    bind_panels(part);
    product_.for_columns(*device_, columns, [&](const GlProgram& program, Index first_column) {
      program.set("rank", columns_);
      program.set("rows", rows_);
      program.set("first_panel", part.first_row);
      program.set("block_panels", part.rows);
      program.set("x_stride", FieldBuffers::padded(columns_));
      program.set("y_stride", FieldBuffers::padded(rows_));
      program.set("first_column", first_column);
      program.dispatch(part.rows);
    });
  }
}

void TallOnDevice::multiply_transposed(Index columns) const {
  if (columns_ == 0) return;
  bind_vectors();
  Index first_chunk = 0;
  for (const StoredRows::Part& part : panels_.parts()) {
    bind_panels(part);
    transposed_.for_columns(*device_, columns, [&](const GlProgram& program, Index first_column) {
      program.set("rank", columns_);
      program.set("first_panel", part.first_row);
      program.set("block_panels", part.rows);
      program.set("panels_of_chunk", panels_of_chunk);
      program.set("first_chunk", first_chunk);
      program.set("columns", columns);
      program.set("x_stride", FieldBuffers::padded(rows_));
      program.set("sum_stride", FieldBuffers::padded(columns_));
      program.set("first_column", first_column);
      program.dispatch(chunks_of(part.rows) * ((columns_ + columns_of_group_ - 1) / columns_of_group_));
    });
    first_chunk += chunks_of(part.rows);
  }
}

template TallOnDevice::TallOnDevice(std::shared_ptr<GlDevice>, const TallMatrix<double>&, RowStrategy,
                                    std::shared_ptr<const GlBuffer>);
template TallOnDevice::TallOnDevice(std::shared_ptr<GlDevice>, const TallMatrix<float>&, RowStrategy,
                                    std::shared_ptr<const GlBuffer>);

}  // namespace radiosity

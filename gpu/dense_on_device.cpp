#include "gpu/dense_on_device.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <type_traits>

namespace radiosity {
namespace {

/// Rows that are sent together: those of a tile row.
constexpr Index strip_rows = 64;
constexpr unsigned entries_binding = 0;
constexpr int rows_of_group = 4;
constexpr int invocations_of_group = 128;

template <typename Scalar>
ShaderFamily shaders_for(RowStrategy strategy) {
  const int half = std::is_same_v<Scalar, Half> ? 1 : 0;
  if (strategy == RowStrategy::group)
    return {"dense_group.comp",
            {{"HALF", half}, {"ROWS", rows_of_group}, {"INVOCATIONS", invocations_of_group}}};
  return {"dense_invocation.comp", {{"HALF", half}, {"ROWS", static_cast<int>(strip_rows)}}};
}

/// How many strips of `strip_bytes` fit into a storage block. Throws Error if none does.
Index strips_of_block(const GlContext& context, Index strip_bytes) {
  const std::int64_t limit = context.limits().storage_block_bytes;
  if (strip_bytes > limit)
    fail(
        "{} rows of the matrix take {} bytes, and a storage block of '{}' at most {}: use fewer patches or "
        "--device cpu",
        strip_rows, strip_bytes, context.renderer(), limit);
  return limit / strip_bytes;
}

/// The rows 64 I ... of a symmetric matrix: its tiles (I, J) for J >= I, and (J, I) transposed.
template <typename Scalar>
void copy_tile_row(const SymmetricTiles<Scalar>& tiles, Index I, Index stride, Scalar* strip) {
  constexpr Index size = SymmetricTiles<Scalar>::tile_size;
  std::fill(strip, strip + strip_rows * stride, Scalar{});
  for (Index J = 0; J < tiles.tile_rows(); ++J) {
    const Index tile = tiles.find_tile(std::min(I, J), std::max(I, J));
    if (tile < 0) continue;
    const Scalar* entries = tiles.tile_data(tile);
    for (Index r = 0; r < size; ++r)
      for (Index c = 0; c < size; ++c)
        strip[r * stride + J * size + c] = J < I ? entries[c * size + r] : entries[r * size + c];
  }
}

}  // namespace

template <typename Scalar>
DenseOnDevice<Scalar>::DenseOnDevice(std::shared_ptr<GlDevice> device, const SymmetricTiles<Scalar>& kernel,
                                     RowStrategy strategy)
    : DeviceMatrix(std::move(device), kernel.size(), kernel.size()),
      stride_(FieldBuffers::padded(kernel.size())),
      scale_(kernel.scale()),
      strategy_(strategy),
      shaders_(shaders_for<Scalar>(strategy)) {
  std::vector<Scalar> strip(static_cast<std::size_t>(strip_rows * stride_));
  upload([&](Index first_row) {
    copy_tile_row(kernel, first_row / strip_rows, stride_, strip.data());
    return strip.data();
  });
}

template <typename Scalar>
DenseOnDevice<Scalar>::DenseOnDevice(std::shared_ptr<GlDevice> device, const RowMajorMatrix<Scalar>& matrix,
                                     RowStrategy strategy)
    : DeviceMatrix(std::move(device), matrix.rows(), matrix.cols()),
      stride_(matrix.stride()),
      scale_(matrix.scale()),
      strategy_(strategy),
      shaders_(shaders_for<Scalar>(strategy)) {
  std::vector<Scalar> strip(static_cast<std::size_t>(strip_rows * stride_));
  upload([&](Index first_row) {
    const Index present = std::min(strip_rows, rows() - first_row);
    std::copy_n(matrix.row(first_row), present * stride_, strip.data());
    std::fill(strip.begin() + present * stride_, strip.end(), Scalar{});
    return strip.data();
  });
}

template <typename Scalar>
template <typename ReadStrip>
void DenseOnDevice<Scalar>::upload(const ReadStrip& read_strip) {
  const CurrentContext current(*device().context());
  const Index strip_bytes = strip_rows * stride_ * static_cast<Index>(sizeof(Scalar));
  const Index strips = FieldBuffers::padded(rows()) / strip_rows;
  const Index most = strips == 0 ? 1 : strips_of_block(*device().context(), strip_bytes);
  for (Index first = 0; first < strips; first += most) {
    const Index count = std::min(most, strips - first);
    GlBuffer entries(device().context(), static_cast<std::size_t>(count * strip_bytes));
    for (Index strip = 0; strip < count; ++strip)
      entries.write(static_cast<std::size_t>(strip * strip_bytes), static_cast<std::size_t>(strip_bytes),
                    read_strip((first + strip) * strip_rows));
    blocks_.push_back({first * strip_rows, count * strip_rows, std::move(entries)});
  }
  device().context()->check("sending a dense matrix");
}

template <typename Scalar>
ByteCount DenseOnDevice<Scalar>::bytes() const {
  std::size_t entries = 0;
  for (const Block& block : blocks_) entries += block.entries.bytes();
  return {{{"entries", entries}}};
}

template <typename Scalar>
void DenseOnDevice<Scalar>::dispatch(Index columns) const {
  const Index rows_together = strategy_ == RowStrategy::group ? rows_of_group : strip_rows;
  for (const Block& block : blocks_) {
    block.entries.bind(entries_binding);
    shaders_.for_columns(device(), columns, [&](const GlProgram& program, Index first_column) {
      program.set("row_quads", stride_ / 4);
      program.set("first_row", block.first_row);
      program.set("block_rows", block.rows);
      program.set("y_stride", FieldBuffers::padded(rows()));
      program.set("first_column", first_column);
      program.dispatch(block.rows / rows_together);
    });
  }
}

template class DenseOnDevice<float>;
template class DenseOnDevice<Half>;

}  // namespace radiosity

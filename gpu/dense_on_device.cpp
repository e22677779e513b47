#include "gpu/dense_on_device.hpp"

#include <algorithm>
#include <epoxy/gl.h>
#include <type_traits>
#include <vector>

namespace radiosity {
namespace {

/// Rows that are sent together: those of a tile row.
constexpr Index strip_rows = 64;
/// Of storage blocks and of texture units.
constexpr unsigned entries_binding = 0;
constexpr unsigned x_unit = 1;
constexpr int rows_of_group = 4;
constexpr int invocations_of_group = 128;
constexpr Index rows_of_vector = 8;

/// In double precision LANES share a row.
constexpr int invocations_of_double_group = 64;
constexpr int lanes_in_double = 16;

template <typename Scalar>
ShaderFamily shaders_for(RowStrategy strategy) {
  if constexpr (std::is_same_v<Scalar, double>)
    return {"dense_double.comp",
            {{"INVOCATIONS", invocations_of_double_group},
             {"LANES", strategy == RowStrategy::group ? lanes_in_double : 1}}};
  if (strategy == RowStrategy::group)
    return {"dense_group.comp",
            {{"HALF", std::is_same_v<Scalar, Half> ? 1 : 0},
             {"ROWS", rows_of_group},
             {"INVOCATIONS", invocations_of_group}}};
  return {"dense_texels.comp", {{"EIGHT", std::is_same_v<Scalar, Half> ? 1 : 0}}};
}

bool below_normal_range(Half number) {
  return (number.bits & 0x7c00) == 0 && (number.bits & 0x03ff) != 0;
}

/// Moves what is below the normal range from a row to the end of `apart`.
void move_subnormal(Half* row, Index cols, CsrMatrix<float>& apart) {
  for (Index c = 0; c < cols; ++c) {
    if (!below_normal_range(row[c])) continue;
    apart.column.push_back(static_cast<std::int32_t>(c));
    apart.value.push_back(to_float(row[c]));
    row[c] = Half{};
  }
  apart.row_begin.push_back(static_cast<std::int64_t>(apart.column.size()));
}

template <typename Scalar>
Index rows_of_work_group(RowStrategy strategy) {
  const bool shared = strategy == RowStrategy::group;
  if (std::is_same_v<Scalar, double>)
    return shared ? invocations_of_double_group / lanes_in_double : invocations_of_double_group;
  return shared ? rows_of_group : rows_of_vector;
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
      strips_(upload([&](Index I, Scalar* strip) { copy_tile_row(kernel, I, stride_, strip); })),
      shaders_(shaders_for<Scalar>(strategy)) {}

template <typename Scalar>
DenseOnDevice<Scalar>::DenseOnDevice(std::shared_ptr<GlDevice> device, const RowMajorMatrix<Scalar>& matrix,
                                     RowStrategy strategy)
    : DeviceMatrix(std::move(device), matrix.rows(), matrix.cols()),
      stride_(matrix.stride()),
      scale_(matrix.scale()),
      strategy_(strategy),
      strips_(upload([&](Index I, Scalar* strip) {
        const Index present = std::min(strip_rows, rows() - I * strip_rows);
        std::copy_n(matrix.row(I * strip_rows), present * stride_, strip);
        std::fill(strip + present * stride_, strip + strip_rows * stride_, Scalar{});
      })),
      shaders_(shaders_for<Scalar>(strategy)) {}

template <typename Scalar>
template <typename ReadStrip>
StoredRows DenseOnDevice<Scalar>::upload(const ReadStrip& read_strip) {
  CsrMatrix<float> apart;
  apart.cols = cols();
  std::vector<Scalar> strip(static_cast<std::size_t>(strip_rows * stride_));
  const auto read = [&](Index I) {
    read_strip(I, strip.data());
    if constexpr (std::is_same_v<Scalar, Half>)
      for (Index r = 0; r < std::min(strip_rows, rows() - I * strip_rows); ++r)
        move_subnormal(strip.data() + r * stride_, cols(), apart);
    return strip.data();
  };
  const CurrentContext current(*device().context());
  StoredRows strips(device().context(),
                    {.rows = FieldBuffers::padded(rows()) / strip_rows,
                     .row_bytes = strip_rows * stride_ * static_cast<Index>(sizeof(Scalar)),
                     .subject = "64 rows of the matrix take"},
                    read);
  if (!apart.value.empty())
    subnormal_ = std::make_unique<CsrOnDevice<float>>(shared_device(), apart, strategy_);
  return strips;
}

template <typename Scalar>
ByteCount DenseOnDevice<Scalar>::bytes() const {
  if (subnormal_ == nullptr) return {{{"entries", strips_.bytes()}}};
  const ByteCount apart = subnormal_->bytes();
  return {{{"entries", strips_.bytes()}, {"subnormal", apart.total()}}};
}

template <typename Scalar>
void DenseOnDevice<Scalar>::dispatch(Index columns) const {
  const bool by_texels = strategy_ == RowStrategy::invocation && !in_double();
  const Index rows_together = rows_of_work_group<Scalar>(strategy_);
  constexpr Texel texel = std::is_same_v<Scalar, Half> ? Texel::four_words : Texel::four_floats;
  TexelUnits& texels = device().texels();
  if (by_texels) texels.show_bound(x_unit, Texel::four_floats, FieldBuffers::x_binding);
  for (const StoredRows::Part& part : strips_.parts()) {
    if (by_texels)
      texels.show(entries_binding, texel, part.buffer);
    else
      part.buffer.bind(entries_binding);
    shaders_.for_columns(device(), columns, [&](const GlProgram& program, Index first_column) {
      program.set("row_quads", stride_ / 4);
      program.set("first_row", part.first_row * strip_rows);
      program.set("block_rows", part.rows * strip_rows);
      program.set("y_stride", FieldBuffers::padded(rows()));
      program.set("first_column", first_column);
      program.dispatch(part.rows * strip_rows / rows_together);
    });
  }
  if (subnormal_ == nullptr) return;
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  subnormal_->dispatch_sum(0, 1, columns);
}

template class DenseOnDevice<double>;
template class DenseOnDevice<float>;
template class DenseOnDevice<Half>;

}  // namespace radiosity

#include "gpu/csr_on_device.hpp"

#include "foundation/error.hpp"
#include "gpu/row_fours.hpp"

#include <algorithm>
#include <cstdint>

namespace radiosity {
namespace {

constexpr unsigned values_binding = 0;
constexpr unsigned columns_binding = 3;
constexpr unsigned row_begin_binding = 4;
constexpr unsigned values_unit = 0;
constexpr unsigned x_of_rows_unit = 1;
constexpr unsigned columns_unit = 2;
constexpr std::size_t entries_of_texel = 4;
/// Invocations of a work group, and how many of them share a row.
struct RowSharing {
  int invocations;
  int lanes;
};
constexpr RowSharing shared_rows{128, 32};
constexpr RowSharing single_rows{64, 1};

const RowSharing& sharing_of(RowStrategy strategy) {
  return strategy == RowStrategy::group ? shared_rows : single_rows;
}

struct RowShape {
  RowStrategy strategy;
  Index together;  ///< rows
  bool in_double;
  bool narrow;  ///< columns in 16 bits
};

ShaderFamily shaders_of_rows(const RowShape& shape, bool adds) {
  const RowSharing& sharing = sharing_of(shape.strategy);
  std::vector<std::pair<std::string, int>> defines = {{"INVOCATIONS", sharing.invocations},
                                                      {"TOGETHER", static_cast<int>(shape.together)},
                                                      {"ADDS", adds ? 1 : 0}};
  if (shape.strategy == RowStrategy::invocation && !shape.in_double) return {"csr_texels.comp", defines};
  defines.emplace_back("LANES", sharing.lanes);
  defines.emplace_back("DOUBLE", shape.in_double ? 1 : 0);
  defines.emplace_back("NARROW", shape.narrow ? 1 : 0);
  return {"csr_rows.comp", defines};
}

template <typename Scalar>
std::int64_t begin_of(const CsrMatrix<Scalar>& matrix, Index row) {
  return matrix.row_begin[static_cast<std::size_t>(row)];
}

/// The row after the last of those from `first` on whose entries and offsets fit into a storage block.
template <typename Scalar>
Index end_of_block(const CsrMatrix<Scalar>& matrix, Index together, Index first, const GlContext& context) {
  const std::int64_t most =
      context.limits().storage_block_bytes / (together * static_cast<std::int64_t>(sizeof(Scalar)));
  const auto from = matrix.row_begin.begin() + first;
  const auto beyond = std::upper_bound(from, matrix.row_begin.end(), *from + most);
  const Index end = std::min<Index>((beyond - matrix.row_begin.begin()) - 1, first + most - 1);
  if (end <= first)
    fail("row {} has {} entries, and a storage block of '{}' has room for {}: use --device cpu",
         first * together, begin_of(matrix, first + 1) - *from, context.renderer(), most);
  return end;
}

/// With zeros up to whole texels.
template <typename Number>
GlBuffer buffer_of(const std::shared_ptr<const GlContext>& context, const Number* numbers,
                   std::size_t count) {
  const std::size_t texels = std::max<std::size_t>((count + entries_of_texel - 1) / entries_of_texel, 1);
  GlBuffer buffer(context, texels * entries_of_texel * sizeof(Number));
  if (count % entries_of_texel > 0) buffer.clear();
  if (count > 0) buffer.write(0, count * sizeof(Number), numbers);
  return buffer;
}

}  // namespace

template <typename Scalar>
CsrOnDevice<Scalar>::CsrOnDevice(std::shared_ptr<GlDevice> device_of_matrix, const CsrMatrix<Scalar>& matrix,
                                 RowStrategy strategy)
    : CsrOnDevice(std::move(device_of_matrix), matrix, row_fours(matrix), strategy) {}

template <typename Scalar>
CsrOnDevice<Scalar>::CsrOnDevice(std::shared_ptr<GlDevice> device_of_matrix, const CsrMatrix<Scalar>& matrix,
                                 const std::optional<CsrMatrix<Scalar>>& fours, RowStrategy strategy)
    : DeviceMatrix(std::move(device_of_matrix), matrix.rows(), matrix.cols),
      strategy_(strategy),
      together_(fours ? 4 : 1),
      narrow_(matrix.cols <= 65536),
      product_(shaders_of_rows({strategy, together_, in_double(), narrow_}, false)),
      sum_(shaders_of_rows({strategy, together_, in_double(), narrow_}, true)) {
  const GlContext& context = *device().context();
  const CurrentContext current(context);
  const CsrMatrix<Scalar>& stored = fours ? *fours : matrix;
  for (Index first = 0; first < stored.rows();) {
    const Index end = end_of_block(stored, together_, first, context);
    upload_block(stored, first, end);
    first = end;
  }
  context.check("sending a sparse matrix");
}

template <typename Scalar>
void CsrOnDevice<Scalar>::upload_block(const CsrMatrix<Scalar>& matrix, Index first_row, Index end_row) {
  const auto& context = device().context();
  const std::int64_t first = begin_of(matrix, first_row);
  const auto count = static_cast<std::size_t>(begin_of(matrix, end_row) - first);
  std::vector<std::uint32_t> row_begin;
  for (Index row = first_row; row <= end_row; ++row)
    row_begin.push_back(static_cast<std::uint32_t>(begin_of(matrix, row) - first));
  blocks_.push_back({first_row, end_row - first_row,
                     buffer_of(context, matrix.value.data() + together_ * first,
                               static_cast<std::size_t>(together_) * count),
                     upload_columns(matrix.column.data() + first, count),
                     buffer_of(context, row_begin.data(), row_begin.size())});
}

template <typename Scalar>
GlBuffer CsrOnDevice<Scalar>::upload_columns(const std::int32_t* columns, std::size_t count) const {
  if (!narrow_) return buffer_of(device().context(), columns, count);
  const std::vector<std::uint16_t> narrow(columns, columns + count);
  return buffer_of(device().context(), narrow.data(), narrow.size());
}

template <typename Scalar>
ByteCount CsrOnDevice<Scalar>::bytes() const {
  std::size_t entries = 0;
  std::size_t indices = 0;
  for (const Block& block : blocks_) {
    entries += block.values.bytes();
    indices += block.columns.bytes() + block.row_begin.bytes();
  }
  return {{{"entries", entries}, {"indices", indices}}};
}

template <typename Scalar>
void CsrOnDevice<Scalar>::dispatch(Index columns) const {
  dispatch_product(0, 1, columns);
}

template <typename Scalar>
void CsrOnDevice<Scalar>::dispatch_product(Index first, Index step, Index columns) const {
  dispatch_rows(product_, first, step, (columns - first + step - 1) / step);
}

template <typename Scalar>
void CsrOnDevice<Scalar>::dispatch_sum(Index first, Index step, Index columns) const {
  dispatch_rows(sum_, first, step, (columns - first + step - 1) / step);
}

template <typename Scalar>
void CsrOnDevice<Scalar>::bind(const Block& block) const {
  block.row_begin.bind(row_begin_binding);
  if (by_texels()) {
    device().texels().show(values_unit, Texel::four_floats, block.values);
    device().texels().show(columns_unit, narrow_ ? Texel::four_shorts : Texel::four_words, block.columns);
  } else {
    block.values.bind(values_binding);
    block.columns.bind(columns_binding);
  }
}

template <typename Scalar>
void CsrOnDevice<Scalar>::dispatch_rows(const ShaderFamily& shaders, Index first, Index step,
                                        Index count) const {
  const Index rows_of_group = sharing_of(strategy_).invocations / sharing_of(strategy_).lanes;
  if (by_texels()) device().texels().show_bound(x_of_rows_unit, Texel::one_float, FieldBuffers::x_binding);
  for (const Block& block : blocks_) {
    bind(block);
    shaders.for_columns(device(), count, [&](const GlProgram& program, Index column) {
      program.set("first_row", block.first_row);
      program.set("block_rows", block.rows);
      program.set("x_stride", FieldBuffers::padded(cols()));
      program.set("y_stride", FieldBuffers::padded(rows()));
      program.set("first_column", first + step * column);
      program.set("column_step", step);
      program.dispatch((block.rows + rows_of_group - 1) / rows_of_group);
    });
  }
}

template class CsrOnDevice<double>;
template class CsrOnDevice<float>;

}  // namespace radiosity

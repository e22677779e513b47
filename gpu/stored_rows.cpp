#include "gpu/stored_rows.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <utility>

namespace radiosity {
namespace {

/// Throws Error if not one row fits.
Index rows_of_part(const GlContext& context, const RowsToStore& shape) {
  if (shape.row_bytes == 0) return std::max<Index>(shape.rows, 1);
  const std::int64_t limit = context.limits().storage_block_bytes;
  const Index most = limit / shape.row_bytes;
  if (most == 0)
    fail("{} {} bytes, and a storage block of '{}' at most {}: {}", shape.subject, shape.row_bytes,
         context.renderer(), limit, shape.remedy);
  return most > shape.together ? most - most % shape.together : most;
}

}  // namespace

StoredRows::StoredRows(const std::shared_ptr<const GlContext>& context, const RowsToStore& shape,
                       const std::function<const void*(Index)>& row) {
  const Index most = rows_of_part(*context, shape);
  const auto row_bytes = static_cast<std::size_t>(shape.row_bytes);
  for (Index first = 0; first < shape.rows; first += most) {
    const Index count = std::min(most, shape.rows - first);
    GlBuffer buffer(context, std::max<std::size_t>(static_cast<std::size_t>(count) * row_bytes, 4));
    for (Index r = 0; r < count && row_bytes > 0; ++r)
      buffer.write(static_cast<std::size_t>(r) * row_bytes, row_bytes, row(first + r));
    parts_.push_back({first, count, std::move(buffer)});
  }
  context->check("sending rows of a matrix");
}

std::size_t StoredRows::bytes() const {
  std::size_t bytes = 0;
  for (const Part& part : parts_) bytes += part.buffer.bytes();
  return bytes;
}

}  // namespace radiosity

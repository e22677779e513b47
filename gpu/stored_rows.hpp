#pragma once

#include "gpu/gl_buffer.hpp"
#include "kernels/products.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace radiosity {

/// What StoredRows keeps, and how it calls that in an error.
struct RowsToStore {
  Index rows = 0;
  Index row_bytes = 0;
  std::string subject;  ///< "a row of tiles takes"
  std::string remedy = "use fewer patches or --device cpu";
  Index together = 1;  ///< parts are multiples of so many rows, unless that is too much
};

/// Rows of equal size on the device, in as many storage blocks as the driver's limit asks for: rows of a
/// matrix, of its blocks or tiles, panels of a factor.
class StoredRows {
 public:
  struct Part {
    Index first_row;
    Index rows;
    GlBuffer buffer;
  };

  /// Copies them: row(r), called for r rising, is where the row_bytes of row r are until the next call.
  /// Throws Error where a row does not fit into a storage block, or all of them not into the device. The
  /// context is current.
  StoredRows(const std::shared_ptr<const GlContext>& context, const RowsToStore& shape,
             const std::function<const void*(Index)>& row);

  const std::vector<Part>& parts() const { return parts_; }
  std::size_t bytes() const;

 private:
  std::vector<Part> parts_;
};

}  // namespace radiosity

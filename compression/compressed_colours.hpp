#pragma once

#include "kernels/colour_texture.hpp"
#include "kernels/exact_rows.hpp"
#include "kernels/products.hpp"
#include "kernels/quantized_tiles.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace radiosity {

/// One n x n matrix a channel, compressed as document 000, section 3.5, has it: texels (a BC1 texture of all
/// channels, or tiles of another format for each) and entries kept apart, which are added to the texels of a
/// texture and stand in place of those of tiles. Rows and columns are stored in an order of their own; fields
/// go in and out in the order of the patches.
class CompressedColours {
 public:
  using Tiles = std::vector<QuantizedTiles>;
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// order[p]: the patch at place p. `exact` has one element a channel with a texture, none with tiles.
  CompressedColours(std::variant<ColourTexture, Tiles> texels, std::vector<ExactRows> exact,
                    std::vector<Index> order);

  Index size() const { return static_cast<Index>(order_.size()); }
  Index channels() const;

  /// Y = M X and Y = M' X, column j with the matrix of channel j mod channels(). Throws UsageError where
  /// shapes do not fit.
  void multiply(const ConstFieldRef& X, FieldRef Y) const;
  void multiply_transposed(const ConstFieldRef& X, FieldRef Y) const;

  /// Null if there are tiles instead.
  const ColourTexture* texture() const { return std::get_if<ColourTexture>(&texels_); }
  /// One a channel; null if there is a texture instead.
  const Tiles* tiles() const { return std::get_if<Tiles>(&texels_); }
  /// What is kept apart, a channel each; empty with tiles.
  const std::vector<ExactRows>& exact() const { return exact_; }
  const std::vector<Index>& order() const { return order_; }

  /// Texels, entries kept apart, their indices, and the order where it is not that of the patches.
  std::vector<std::pair<std::string, std::size_t>> byte_parts() const;

  /// Rows in groups of 64 places, the last of fewer.
  static constexpr Index rows_of_group = 64;
  Index row_groups() const { return (size() + rows_of_group - 1) / rows_of_group; }
  /// The rows at the places 64 group ... of a channel's matrix, columns in the order of places: plainly
  /// decoded.
  RowMatrix decode_rows(Index channel, Index group) const;

  /// The matrix of a channel in the order of the patches, n x n.
  Eigen::MatrixXd materialize(Index channel) const;

 private:
  void multiply_stored(const Eigen::MatrixXd& X, Eigen::MatrixXd& Y, bool transposed) const;
  void multiply_in_order(const ConstFieldRef& X, FieldRef Y, bool transposed) const;

  InstructionSet instructions_ = best_instruction_set();
  std::variant<ColourTexture, Tiles> texels_;
  std::vector<ExactRows> exact_;
  std::vector<Index> order_;
  bool identity_;
};

}  // namespace radiosity

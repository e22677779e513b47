#pragma once

#include "kernels/csr_matrix.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace radiosity {

/// A sparse m x n matrix by groups of 16 rows: for each column in which rows of a group have entries a mask
/// of these rows, and their values one after the other, without zeros between them (Bramas and Kus,
/// "Computing the sparse matrix vector product using block-based kernels without zero padding on processors
/// with AVX-512 instructions", PeerJ Computer Science 2018). Rows of neighbouring patches see the same
/// patches, so that an index serves many entries and one number of X several rows.
template <typename Scalar>
class RowGroups {
 public:
  static constexpr Index rows_of_group = 16;

  /// Columns of `matrix` rise within its rows.
  explicit RowGroups(const CsrMatrix<Scalar>& matrix);

  Index rows() const { return rows_; }
  Index cols() const { return cols_; }
  Index groups() const { return (rows_ + rows_of_group - 1) / rows_of_group; }
  std::size_t entries() const { return values_.size() - readable_beyond; }

  /// The elements of a group are one for each of its columns, rising.
  struct Group {
    const Scalar* values;  ///< by elements and, in those, by rows; 16 numbers beyond the last may be read
    const std::int32_t* columns;  ///< one an element
    const std::uint16_t* masks;   ///< one an element: bit r for row r of the group, one at least
    std::size_t elements;
  };
  Group group(Index g) const {
    const auto k = static_cast<std::size_t>(g);
    return {values_.data() + value_begin_[k], columns_.data() + begin_[k], masks_.data() + begin_[k],
            begin_[k + 1] - begin_[k]};
  }

  /// Calls visit(row, column, value) for every entry, columns rising within each row.
  template <typename Visit>
  void visit_entries(const Visit& visit) const {
    for (Index g = 0; g < groups(); ++g) {
      const Group own = group(g);
      const Scalar* value = own.values;
      for (std::size_t e = 0; e < own.elements; ++e)
        for (unsigned mask = own.masks[e]; mask != 0; mask &= mask - 1)
          visit(g * rows_of_group + std::countr_zero(mask), own.columns[e], *value++);
    }
  }

  /// The same matrix, columns rising within rows.
  CsrMatrix<Scalar> compressed_rows() const;

  std::size_t value_bytes() const { return entries() * sizeof(Scalar); }
  std::size_t index_bytes() const {
    return columns_.size() * sizeof(std::int32_t) + masks_.size() * sizeof(std::uint16_t) +
           (begin_.size() + value_begin_.size()) * sizeof(std::size_t);
  }

 private:
  static constexpr std::size_t readable_beyond = 16;

  Index rows_;
  Index cols_;
  std::vector<std::size_t> begin_ = {0};        ///< of the elements of each group
  std::vector<std::size_t> value_begin_ = {0};  ///< of its values
  std::vector<std::int32_t> columns_;
  std::vector<std::uint16_t> masks_;
  std::vector<Scalar> values_;  ///< and zeros that may be read
};

extern template class RowGroups<float>;
extern template class RowGroups<double>;

}  // namespace radiosity

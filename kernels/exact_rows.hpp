#pragma once

#include "kernels/csr_matrix.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace radiosity {

using Index = Eigen::Index;

/// Entries of an m x n matrix that are kept apart from a compressed one, by rows: values in float32, columns
/// in 16 bits where n <= 65536, else in 32.
class ExactRows {
 public:
  struct Row {
    std::vector<std::int32_t> column;  ///< rising
    std::vector<float> value;
  };

  ExactRows(Index columns, const std::vector<Row>& rows);

  Index rows() const { return static_cast<Index>(begin_.size()) - 1; }
  Index columns() const { return columns_; }

  /// y += scale M x and y += scale M' x, in double. x and y have as many numbers as M has columns and rows,
  /// or rows and columns. The result does not depend on the number of threads.
  void add_product(double scale, const Eigen::Ref<const Eigen::VectorXd>& x,
                   Eigen::Ref<Eigen::VectorXd> y) const;
  void add_transposed_product(double scale, const Eigen::Ref<const Eigen::VectorXd>& x,
                              Eigen::Ref<Eigen::VectorXd> y) const;

  /// Adds the entries of a row to n numbers.
  void add_row(Index row, double* numbers) const;

  /// The same by compressed rows with columns of 32 bits.
  CsrMatrix<float> compressed_rows() const;

  std::size_t value_bytes() const { return values_.size() * sizeof(float); }
  std::size_t index_bytes() const {
    return narrow_.size() * sizeof(std::uint16_t) + wide_.size() * sizeof(std::uint32_t) +
           begin_.size() * sizeof(std::size_t);
  }

 private:
  template <typename Visit>
  void visit_columns(const Visit& visit) const;

  Index columns_;
  std::vector<std::size_t> begin_;  ///< row i owns the entries begin_[i] ... begin_[i + 1] - 1
  std::vector<std::uint16_t> narrow_;
  std::vector<std::uint32_t> wide_;
  std::vector<float> values_;
};

}  // namespace radiosity

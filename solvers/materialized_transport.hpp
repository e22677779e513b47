#pragma once

#include "operators/kernel_operator.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace radiosity {

/// Throws Error if `matrices` n x n matrices of doubles take more than `limit` bytes; `name` is the solver
/// that wants them.
void require_memory(const std::string& name, Index n, Index matrices, std::size_t limit);

/// K of an operator, n x n, by products with blocks of unit fields; costs n products of one column.
Eigen::MatrixXd kernel_matrix(const KernelOperator& transport);

/// T of every channel, n x n each, as any operator's products show it.
std::vector<Eigen::MatrixXd> transport_matrices(const LinearOperator& transport);

/// The entries of T in scaled coordinates b = A^{1/2} B, by rows: one matrix for all channels where a kernel
/// lies under T, else one a channel. For solvers that go through T entry by entry.
class TransportRows {
 public:
  /// The operator outlives the rows, and a kernel's reflectance is read when it is needed: it may change.
  /// Throws Error if the entries take more than `limit` bytes.
  TransportRows(const std::string& name, const LinearOperator& transport, const Eigen::VectorXd& root_area,
                std::size_t limit);

  /// sum_k (A^{1/2} T A^{-1/2})_ik b_k for a channel.
  double gather(Index i, Index channel, const Eigen::VectorXd& scaled_field) const;

 private:
  const KernelOperator* kernel_;          ///< null where the matrices contain the reflectance
  std::vector<Eigen::MatrixXd> columns_;  ///< transposed, so that a row of T is contiguous
};

}  // namespace radiosity

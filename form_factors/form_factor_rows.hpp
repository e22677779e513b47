#pragma once

#include "form_factors/form_factors.hpp"

#include <Eigen/Core>

#include <memory>
#include <span>
#include <vector>

namespace radiosity {

class PairExchange;

/// Form factors of the accurate method on demand: any row, column or block, and sums over groups of patches,
/// without an n x n matrix. Each number equals the entry that compute_form_factors assembles with the same
/// tolerance and seed before any closure, up to the rounding of a sum. Safe to call from several threads.
class FormFactorRows {
 public:
  explicit FormFactorRows(std::shared_ptr<const PatchMesh> mesh, double tolerance = 1e-4,
                          std::uint64_t seed = 1);
  ~FormFactorRows();

  Index patch_count() const;

  /// F_ij for all j, n.
  Eigen::VectorXd row(Index i) const;

  /// F_ij for all i, n: by reciprocity from row j.
  Eigen::VectorXd column(Index j) const;

  /// F_ij for i in rows and j in columns, rows x columns.
  Eigen::MatrixXd block(std::span<const Index> rows, std::span<const Index> columns) const;

  /// n x k: entry (i, g) is the sum of F_ij over the patches j with group_of_patch[j] = g, 0 <= g < k; other
  /// patches (-1) are left out. Works row by row in parallel and keeps nothing of n x n.
  Eigen::MatrixXd panel(std::span<const int> group_of_patch, Index k, Monitor& monitor) const;

 private:
  // Patch i's exchange with the clusters that `wanted` marks, scaled to F_ij, into row (n).
  void fill_row(Index i, const std::vector<char>* wanted, Eigen::VectorXd& row) const;

  std::shared_ptr<const PatchMesh> mesh_;
  std::unique_ptr<PairExchange> exchange_;
};

}  // namespace radiosity

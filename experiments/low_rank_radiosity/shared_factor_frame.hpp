#pragma once

#include "kernels/products.hpp"
#include "kernels/segments.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace radiosity {

/// All bounces in all colours from one U: B_c = E_c + R_c U C_c^{-1} (V' E_c), C_c = I - V' R_c U. Where
/// document 004 stores a Y for every channel, this stores U, which knows no reflectance, and a k x k matrix a
/// channel: n k + 6 k^2 floats in place of 3 n k for three channels, and new colours need no new Y. Fields
/// are sorted by patch, as V and U are.
class SharedFactorFrame {
 public:
  /// `reflectance`: n x c. V and U are used, not copied. Throws as transposed_capacitance().
  SharedFactorFrame(const Segments& V, const TallMatrix<float>& U, Eigen::MatrixXd reflectance);

  /// New colours: c matrices of k x k are made anew.
  void set_reflectance(Eigen::MatrixXd reflectance);

  /// B from E, both n x c; B does not alias E. Not from two threads at once.
  void solve(const ConstFieldRef& E, FieldRef B);

  /// Of U, V and the k x k matrices; diagonals not counted.
  std::size_t bytes() const;

 private:
  const Segments& V_;
  const TallMatrix<float>& U_;
  Eigen::MatrixXd reflectance_;
  std::vector<Eigen::MatrixXd> inverses_;  ///< C_c^{-1}'
  Eigen::MatrixXd sums_;                   ///< k x c
  Eigen::MatrixXd coefficients_;
};

}  // namespace radiosity

#include "form_factors/form_factors.hpp"

#include "foundation/parallel.hpp"
#include "kernels/products.hpp"

#include <cmath>

namespace radiosity {

double FormFactors::operator()(Index i, Index j) const {
  if (unsymmetric) return (*unsymmetric)(i, j);
  return (*kernel)(i, j) * std::sqrt(mesh->area[j] / mesh->area[i]);
}

Eigen::VectorXd FormFactors::row_sums() const {
  const Index n = patch_count();
  Eigen::MatrixXd sums(n, 1);
  if (unsymmetric) {
    multiply(*unsymmetric, Eigen::MatrixXd::Ones(n, 1), sums);
    return sums.col(0);
  }
  const Eigen::VectorXd root_area = mesh->area.cwiseSqrt();
  multiply(*kernel, root_area, sums);
  return sums.col(0).cwiseQuotient(root_area);
}

Eigen::MatrixXd FormFactors::matrix() const {
  const Index n = patch_count();
  Eigen::MatrixXd F(n, n);
  parallel_for(static_cast<std::size_t>(n), [&](std::size_t row) {
    const auto i = static_cast<Index>(row);
    for (Index j = 0; j < n; ++j) F(i, j) = (*this)(i, j);
  });
  return F;
}

}  // namespace radiosity

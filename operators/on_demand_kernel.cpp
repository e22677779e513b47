#include "operators/on_demand_kernel.hpp"

#include "foundation/parallel.hpp"
#include "operators/storage_choice.hpp"

namespace radiosity {
namespace {

FormFactors without_kernel(const std::shared_ptr<const PatchMesh>& mesh) {
  FormFactors form_factors;
  form_factors.mesh = mesh;
  return form_factors;
}

}  // namespace

OnDemandKernel::OnDemandKernel(const std::shared_ptr<const PatchMesh>& mesh, double tolerance,
                               std::uint64_t seed)
    : KernelOperator(without_kernel(mesh)), rows_(mesh, tolerance, seed) {}

ByteCount OnDemandKernel::bytes() const {
  return {{{"diagonals", diagonal_bytes(size(), channels())}}};
}

void OnDemandKernel::multiply_kernel(const ConstFieldRef& X, FieldRef Y) const {
  // K_ij = F_ij (A_i / A_j)^{1/2}.
  const Field scaled = root_area().cwiseInverse().asDiagonal() * X;
  parallel_for(static_cast<std::size_t>(size()), [&](std::size_t row) {
    const auto i = static_cast<Index>(row);
    const Eigen::VectorXd factors = rows_.row(i);
    for (Index j = 0; j < X.cols(); ++j) Y(i, j) = root_area()[i] * factors.dot(scaled.col(j));
  });
}

}  // namespace radiosity

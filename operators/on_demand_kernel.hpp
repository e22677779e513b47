#pragma once

#include "form_factors/form_factor_rows.hpp"
#include "operators/kernel_operator.hpp"

#include <cstdint>
#include <memory>

namespace radiosity {

/// The true kernel of the accurate method that is never stored: every product computes its rows afresh, with
/// the entries that compute_form_factors assembles before any closure. For scenes whose kernel does not fit:
/// a product costs twice an assembly (both directions of a pair), so that few are wanted, as conjugate
/// gradients need that are preconditioned by an operator which does fit (`cg:preconditioner=`, built from
/// cheaper form factors), or as rows for sampled_error_bound.
class OnDemandKernel final : public KernelOperator {
 public:
  explicit OnDemandKernel(const std::shared_ptr<const PatchMesh>& mesh, double tolerance = 1e-4,
                          std::uint64_t seed = 1);

  ByteCount bytes() const override;
  std::string describe() const override { return "on-demand"; }

  const FormFactorRows& rows() const { return rows_; }

 protected:
  void multiply_kernel(const ConstFieldRef& X, FieldRef Y) const override;

 private:
  FormFactorRows rows_;
};

}  // namespace radiosity

#include "solvers/symmetric_kernel.hpp"

#include "foundation/error.hpp"

namespace radiosity {

const KernelOperator& require_symmetric_kernel(const std::string& solver, const LinearOperator& transport) {
  const auto* kernel = dynamic_cast<const KernelOperator*>(&transport);
  if (kernel == nullptr || !transport.symmetric())
    fail<UsageError>("{} needs a symmetric kernel, which the operator {} is not: use gmres.", solver,
                     transport.describe());
  return *kernel;
}

}  // namespace radiosity

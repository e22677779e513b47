#pragma once

#include "operators/kernel_operator.hpp"

#include <string>

namespace radiosity {

/// The operator as a symmetric kernel; throws UsageError that opens with the solver's name if it is none.
const KernelOperator& require_symmetric_kernel(const std::string& solver, const LinearOperator& transport);

}  // namespace radiosity

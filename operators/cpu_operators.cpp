#include "operators/csr_operator.hpp"
#include "operators/dense_operator.hpp"
#include "operators/operator_registry.hpp"

namespace radiosity {

OperatorRegistry cpu_operators() {
  return OperatorRegistry({
      {"dense", "every entry of the kernel, as f64, f32 or f16", "dense:f64", make_dense_operator},
      {"csr", "the entries that are not zero, as f64 or f32, by compressed rows", "csr:f64",
       make_csr_operator},
  });
}

}  // namespace radiosity

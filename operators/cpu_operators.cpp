#include "operators/csr_operator.hpp"
#include "operators/dense_operator.hpp"
#include "operators/neumann_sparse_operator.hpp"
#include "operators/operator_registry.hpp"
#include "operators/quantized_operator.hpp"
#include "operators/svd_operator.hpp"
#include "operators/topk_operator.hpp"

namespace radiosity {

OperatorRegistry cpu_operators() {
  return OperatorRegistry({
      {.name = "dense",
       .summary = "every entry of the kernel, as f64, f32 or f16",
       .defaults = "dense:f64",
       .make = make_dense_operator,
       .variants = {"dense:f32", "dense:f16"}},
      {.name = "csr",
       .summary = "the entries that are not zero, as f64 or f32, by compressed rows",
       .defaults = "csr:f64",
       .make = make_csr_operator,
       .variants = {"csr:f32"}},
      {.name = "quantized",
       .summary = "the kernel in codes of 8, 4 or 2 bits, and its entries that matter most in float32",
       .defaults = "quantized:bits=4,block=32,exact=0.01,diffusion=1",
       .make = make_quantized_operator,
       .closure = "automatic",
       .lossy = true,
       .variants = {"quantized:bits=8", "quantized:bits=2"}},
      {.name = "topk",
       .summary = "the largest entries of the kernel in float32, the others dropped",
       .defaults = "topk:fraction=0.1",
       .make = make_topk_operator,
       .closure = "automatic",
       .lossy = true},
      {.name = "svd",
       .summary = "the best approximation of rank k, in the plain or the area norm; from all entries",
       .defaults = "svd:k=64,norm=plain,storage=f32",
       .make = make_svd_operator,
       .lossy = true,
       .cubic = true,
       .variants = {"svd:k=32,norm=area", "svd:k=32,global=1"}},
      {.name = "rsvd",
       .summary = "a randomized SVD of rank k, in the plain or the area norm; from products",
       .defaults = "rsvd:k=64,norm=plain,storage=f32,power=1,oversampling=10,seed=1",
       .make = make_rsvd_operator,
       .lossy = true,
       .variants = {"rsvd:k=32,norm=area"}},
      {.name = "neumann-sparse",
       .summary = "E -> B by the sum of all bounces, the small entries of each dropped",
       .defaults = "neumann-sparse:threshold=1e-05,bounces=1000",
       .make = make_neumann_sparse_operator,
       .lossy = true,
       .cubic = true,
       .variants = {"neumann-sparse:threshold=1e-3"}},
  });
}

}  // namespace radiosity

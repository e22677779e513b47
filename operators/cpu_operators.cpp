#include "operators/bounces_operator.hpp"
#include "operators/csr_operator.hpp"
#include "operators/cur_operator.hpp"
#include "operators/dct_operator.hpp"
#include "operators/dense_operator.hpp"
#include "operators/dxt_operator.hpp"
#include "operators/neumann_sparse_operator.hpp"
#include "operators/operator_registry.hpp"
#include "operators/qr_operator.hpp"
#include "operators/quantized_operator.hpp"
#include "operators/svd_operator.hpp"
#include "operators/topk_operator.hpp"
#include "operators/two_mesh_operator.hpp"
#include "operators/wavelet_operator.hpp"

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
       .defaults = "svd:k=64,norm=plain,storage=f32,method=dense",
       .make = make_svd_operator,
       .lossy = true,
       .cubic = true,
       .variants = {"svd:k=32,norm=area", "svd:k=8,method=lanczos", "svd:k=32,global=1"}},
      {.name = "rsvd",
       .summary = "a randomized SVD of rank k, in the plain or the area norm; from products",
       .defaults = "rsvd:k=64,norm=plain,storage=f32,power=1,oversampling=10,seed=1",
       .make = make_rsvd_operator,
       .lossy = true,
       .variants = {"rsvd:k=32,norm=area"}},
      {.name = "2msc",
       .summary = "two meshes with spatial coherence: what k patches send, averaged over each",
       .defaults = "2msc:k=64,mesh=adaptive,assign=inclusion,sides=one,storage=f32",
       .make = make_two_mesh_operator,
       .lossy = true,
       .variants = {"2msc:k=32,sides=two"}},
      {.name = "sparse-v",
       .summary = "2msc with V as sums over the elements of each patch: half the bytes, half the time",
       .defaults = "sparse-v:k=64,mesh=adaptive,assign=inclusion,storage=f32,factors=sums",
       .make = make_sparse_v_operator,
       .lossy = true,
       .direct = true},
      {.name = "qr",
       .summary = "an orthonormal basis of k columns of F, and F projected on it",
       .defaults = "qr:k=64,norm=plain,storage=f32,columns=2msc,mesh=adaptive,assign=inclusion",
       .make = make_qr_operator,
       .lossy = true,
       .variants = {"qr:k=32,norm=area", "qr:k=32,columns=pivoted"}},
      {.name = "cur",
       .summary = "k columns and k rows of F and a small matrix between them",
       .defaults = "cur:k=64,norm=plain,storage=f32,core=projection,seed=1",
       .make = make_cur_operator,
       .lossy = true,
       .variants = {"cur:k=32,norm=area", "cur:k=32,core=interpolation"}},
      {.name = "wavelet",
       .summary = "F projected on the k Haar wavelets that carry most of it",
       .defaults = "wavelet:k=64,norm=plain,storage=f32,seed=1",
       .make = make_wavelet_operator,
       .lossy = true,
       .variants = {"wavelet:k=32,norm=area"}},
      {.name = "dct",
       .summary = "F projected on the k functions of the cosine transform that carry most of it",
       .defaults = "dct:k=64,norm=plain,storage=f32,seed=1",
       .make = make_dct_operator,
       .lossy = true,
       .variants = {"dct:k=32,norm=area"}},
      {.name = "neumann-sparse",
       .summary = "E -> B by the sum of all bounces, the small entries of each dropped",
       .defaults = "neumann-sparse:threshold=1e-05,bounces=1000",
       .make = make_neumann_sparse_operator,
       .lossy = true,
       .cubic = true,
       .variants = {"neumann-sparse:threshold=1e-3"}},
      {.name = "bounces",
       .summary = "E -> B after k bounces by one product: the sum of all paths of up to k, in full",
       .defaults = "bounces:k=3,storage=f32",
       .make = make_bounces_operator,
       .lossy = true,
       .cubic = true,
       .variants = {"bounces:k=inf,storage=f64", "bounces:k=10,storage=f16"}},
      {.name = "dxt",
       .summary = "document 000's compressed matrix: the largest of each row, BC1 blocks of logarithms",
       .defaults = "dxt:bounces=1,exact=0.04,reorder=both,codec=bc1,range=25,fill=0",
       .make = make_dxt_operator,
       .lossy = true,
       .cubic = true,
       .variants = {"dxt:reorder=morton,range=auto,fill=1,fit=cluster", "dxt:bounces=3",
                    "dxt:codec=bc4,reorder=2opt", "dxt:codec=f16,start=random,reorder=none",
                    "dxt:codec=u4,map=linear", "dxt:matrix=kernel,reorder=morton,range=auto,fill=1",
                    "dxt:matrix=kernel,codec=u8", "dxt:matrix=kernel,codec=bf16,reorder=none"}},
  });
}

}  // namespace radiosity

#include "operators/compressed_kernel_operator.hpp"

#include "operators/kernel_error.hpp"
#include "operators/kernel_operator.hpp"
#include "operators/quantized_kernel_operator.hpp"
#include "operators/rounding_certificate.hpp"
#include "operators/storage_choice.hpp"
#include "operators/stored_matrix.hpp"

#include <utility>

namespace radiosity {
namespace {

ColourMatrix full_kernel(const SymmetricTiles<double>& K) {
  return materialize(K).cast<float>();
}

/// K with rows and columns in another order: order[p] at place p.
SymmetricTiles<double> reordered(const SymmetricTiles<double>& K, const std::vector<Index>& order) {
  SymmetricTiles<double> result(K.size(), [](Index, Index) { return true; });
  for (Index p = 0; p < K.size(); ++p)
    for (Index q = p; q < K.size(); ++q)
      result.set(p, q, K(order[static_cast<std::size_t>(p)], order[static_cast<std::size_t>(q)]));
  return result;
}

class CompressedKernelOperator final : public KernelOperator, public HasCompressedKernel {
 public:
  CompressedKernelOperator(const FormFactors& form_factors, CompressedKernel kernel, std::string spec)
      : KernelOperator(form_factors),
        tiles_(std::move(kernel.tiles)),
        order_(std::move(kernel.order)),
        spec_(std::move(spec)) {
    const SymmetricTiles<double> truth = reordered(*form_factors.kernel, order_);
    KernelError error = kernel_error(truth, tiles_, root_area()(order_));
    const Eigen::VectorXd true_rows = error.true_row_sums, own_rows = error.approximate_row_sums;
    error.true_row_sums(order_) = true_rows;
    error.approximate_row_sums(order_) = own_rows;
    certificate_ =
        approximation_certificate(error, product_rounding<float>(size()), reflectance(), root_area());
  }

  ByteCount bytes() const override {
    return {{{"texels", tiles_.code_bytes()},
             {"exact", tiles_.exact_bytes()},
             {"directory", tiles_.directory_bytes()},
             {"permutation", order_.size() * sizeof(Index)},
             {"diagonals", diagonal_bytes(size(), channels())}}};
  }
  std::string describe() const override { return spec_; }
  Certificate certificate() const override { return certificate_; }
  double product_roundoff() const override { return 0x1p-24; }
  const QuantizedTiles& compressed_kernel() const override { return tiles_; }
  const std::vector<Index>& kernel_order() const override { return order_; }

 protected:
  void multiply_kernel(const ConstFieldRef& X, FieldRef Y) const override {
    Field product(X.rows(), X.cols());
    multiply(tiles_, X(order_, Eigen::all), product, instructions_);
    Y(order_, Eigen::all) = product;
  }

 private:
  InstructionSet instructions_ = best_instruction_set();
  QuantizedTiles tiles_;
  std::vector<Index> order_;  ///< the patch at each place
  std::string spec_;
  Certificate certificate_;
};

}  // namespace

std::unique_ptr<LinearOperator> make_compressed_kernel(const ColourCompressionOptions& options,
                                                       const TexelOrder& row_order, const std::string& spec,
                                                       const FormFactors& form_factors) {
  require_symmetric_kernel(form_factors, spec);
  return std::make_unique<CompressedKernelOperator>(
      form_factors, compress_kernel(full_kernel(*form_factors.kernel), options, row_order), spec);
}

}  // namespace radiosity

#include "threshold_operator.hpp"

#include <algorithm>
#include <memory>
#include <radiosity/kernels/csr_matrix.hpp>
#include <radiosity/kernels/products.hpp>
#include <radiosity/kernels/symmetric_tiles.hpp>
#include <radiosity/operators/kernel_operator.hpp>

namespace {

using namespace radiosity;

/// The entries of at least `smallest`, both halves.
CsrMatrix<double> large_entries(const SymmetricTiles<double>& kernel, double smallest) {
  CsrMatrix<double> all = compress<double>(kernel);
  CsrMatrix<double> large;
  large.cols = all.cols;
  for (Index i = 0; i < all.rows(); ++i) {
    for (auto k = all.row_begin[static_cast<std::size_t>(i)];
         k < all.row_begin[static_cast<std::size_t>(i) + 1]; ++k) {
      const auto entry = static_cast<std::size_t>(k);
      if (all.value[entry] < smallest) continue;
      large.column.push_back(all.column[entry]);
      large.value.push_back(all.value[entry]);
    }
    large.row_begin.push_back(static_cast<std::int64_t>(large.value.size()));
  }
  return large;
}

class ThresholdOperator final : public KernelOperator {
 public:
  ThresholdOperator(const FormFactors& form_factors, double below)
      : KernelOperator(form_factors), below_(below), kernel_(compress<double>(*form_factors.kernel)) {
    const double largest = *std::max_element(kernel_.value.begin(), kernel_.value.end());
    kernel_ = large_entries(*form_factors.kernel, below * largest);
  }

  ByteCount bytes() const override {
    return {{{"entries", kernel_.value_bytes()}, {"indices", kernel_.index_bytes()}}};
  }

  std::string describe() const override { return fmt::format("threshold:below={}", below_); }

 private:
  void multiply_kernel(const ConstFieldRef& X, FieldRef Y) const override { multiply(kernel_, X, Y); }

  double below_;
  CsrMatrix<double> kernel_;
};

}  // namespace

radiosity::OperatorEntry threshold_operator() {
  return {"threshold", "the kernel without its small entries", "threshold:below=0.01",
          [](Spec& spec, const FormFactors& form_factors) -> std::unique_ptr<LinearOperator> {
            if (!form_factors.symmetric()) fail<UsageError>("threshold needs symmetric form factors");
            return std::make_unique<ThresholdOperator>(form_factors, spec.number("below", 0.01, 0, 1));
          }};
}

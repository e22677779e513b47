// O5: what storage loses of the energy that rows of F carry.

#include "operators/operator_registry.hpp"
#include "tests/conformance/transport_cases.hpp"

#include <gtest/gtest.h>

namespace radiosity {
namespace {

/// Entries over four decades, rows of F near 1.
FormFactors wide_kernel() {
  const Index n = 200;
  Eigen::MatrixXd kernel(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const double distance = 0.02 + static_cast<double>(i > j ? i - j : j - i) / n;
      kernel(i, j) = i == j || (i / 9 + j / 9) % 4 == 0 ? 0 : 1 / (distance * distance);
    }
  const Eigen::VectorXd sums = kernel.rowwise().sum();
  kernel =
      (sums.cwiseSqrt().cwiseInverse().asDiagonal() * kernel * sums.cwiseSqrt().cwiseInverse().asDiagonal())
          .eval();
  return symmetric_form_factors(kernel, Eigen::VectorXd::LinSpaced(n, 0.5, 2),
                                Eigen::MatrixXd::Constant(n, 1, 0.8));
}

double worst_row(const std::string& spec) {
  const FormFactors F = wide_kernel();
  const auto transport = cpu_operators().make(spec, F);
  Field sums(transport->size(), 1);
  transport->apply(Field::Ones(transport->size(), 1), sums);
  return (sums.col(0) / 0.8 - F.row_sums()).cwiseAbs().maxCoeff();
}

TEST(Energy, RowSumsKeepWhatTheirBitsAllow) {
  EXPECT_LE(worst_row("dense"), 1e-13);
  EXPECT_LE(worst_row("dense:f32"), 1e-6);
  EXPECT_LE(worst_row("dense:f16,closure=symmetric"), 1e-6);
  EXPECT_LE(worst_row("dense:f16,closure=blocks"), 1e-6);
  EXPECT_LE(worst_row("quantized:bits=8,closure=none"), 1e-3);
  EXPECT_LE(worst_row("quantized:bits=2"), 1e-6);  // closed by default
  EXPECT_LE(worst_row("topk"), 1e-6);
  // Without a closure they lose more, and the check can fail.
  EXPECT_GT(worst_row("dense:f16"), 1e-6);
  EXPECT_GT(worst_row("quantized:bits=2,closure=none"), 1e-3);
  EXPECT_GT(worst_row("topk:closure=none"), 1e-1);
}

TEST(Energy, DiffusionKeepsMoreOfItThanRounding) {
  EXPECT_LT(worst_row("quantized:bits=2,exact=0,closure=none"),
            worst_row("quantized:bits=2,exact=0,diffusion=0,closure=none"));
}

}  // namespace
}  // namespace radiosity

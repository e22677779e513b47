#include "foundation/error.hpp"
#include "foundation/random.hpp"
#include "operators/closed_operator.hpp"
#include "operators/kernel_operator.hpp"
#include "operators/operator_registry.hpp"
#include "tests/conformance/transport_cases.hpp"

#include <gtest/gtest.h>

namespace radiosity {
namespace {

Eigen::MatrixXd block_kernel(int rooms, Index n, double door, std::uint64_t seed) {
  RandomStream random(seed);
  Eigen::MatrixXd kernel(rooms * n, rooms * n);
  for (Index i = 0; i < kernel.rows(); ++i)
    for (Index j = 0; j <= i; ++j)
      kernel(i, j) = kernel(j, i) =
          random.uniform(0.5, 1) * (i / n == j / n ? 1 : door) / static_cast<double>(n);
  return kernel;
}

FormFactors rooms_with_kernel(const Eigen::MatrixXd& kernel) {
  return symmetric_form_factors(kernel, Eigen::VectorXd::LinSpaced(kernel.rows(), 0.8, 1.2),
                                Eigen::MatrixXd::Constant(kernel.rows(), 1, 0.95));
}

/// K with every entry wrong by up to a tenth, too large on average; a signed one has negative entries.
class WrongKernel final : public KernelOperator {
 public:
  WrongKernel(const FormFactors& form_factors, double shift)
      : KernelOperator(form_factors), kernel_(materialize(*form_factors.kernel)) {
    RandomStream random(9);
    for (Index i = 0; i < kernel_.rows(); ++i)
      for (Index j = 0; j <= i; ++j) kernel_(i, j) = kernel_(j, i) *= 1 + random.uniform(0, 0.1) + shift;
  }
  ByteCount bytes() const override { return {{{"entries", 8}}}; }
  std::string describe() const override { return "wrong"; }
  const Eigen::MatrixXd& kernel() const { return kernel_; }

 private:
  void multiply_kernel(const ConstFieldRef& X, FieldRef Y) const override { Y = kernel_.lazyProduct(X); }
  Eigen::MatrixXd kernel_;
};

std::unique_ptr<LinearOperator> closed(const FormFactors& form_factors, const std::string& keys,
                                       double shift = 0) {
  Spec spec = Spec::parse("wrong:" + keys);
  const ClosureChoice choice = ClosureChoice::take(spec);
  spec.finish();
  return close_operator(std::make_unique<WrongKernel>(form_factors, shift), choice, form_factors);
}

Eigen::VectorXd sums_of(const LinearOperator& transport) {
  Field sums(transport.size(), 1);
  transport.apply(Field::Ones(transport.size(), 1), sums);
  return sums.col(0) / 0.95;
}

double largest_row_error(const LinearOperator& transport, const FormFactors& form_factors) {
  return (sums_of(transport) - form_factors.row_sums()).cwiseAbs().maxCoeff();
}

TEST(ClosedOperator, RestoresRowSums) {
  const FormFactors F = rooms_with_kernel(block_kernel(1, 60, 0, 1));
  EXPECT_GT(largest_row_error(*closed(F, "closure=none"), F), 0.01);  // the check can fail
  EXPECT_LT(largest_row_error(*closed(F, "closure=rows"), F), 1e-13);
  EXPECT_LT(largest_row_error(*closed(F, "closure=symmetric"), F), 1e-12);
  EXPECT_LT(largest_row_error(*closed(F, "closure=blocks,blocks=1"), F), 1e-13);
  EXPECT_LT(largest_row_error(*closed(F, "closure=automatic"), F), 1e-12);
}

TEST(ClosedOperator, SymmetryIsKeptExceptByRows) {
  const FormFactors F = rooms_with_kernel(block_kernel(2, 30, 0.02, 2));
  EXPECT_FALSE(closed(F, "closure=rows")->symmetric());
  for (const char* keys : {"closure=symmetric", "closure=blocks", "closure=blocks,blocks=7"}) {
    const auto transport = closed(F, keys);
    ASSERT_TRUE(transport->symmetric()) << keys;
    const auto& kernel = dynamic_cast<const KernelOperator&>(*transport);
    Field K(60, 60);
    kernel.apply_kernel(Field::Identity(60, 60), K);
    EXPECT_LT((K - K.transpose()).norm(), 1e-14 * K.norm()) << keys;
    EXPECT_EQ(transport->describe(), std::string("wrong:") + keys);
    EXPECT_GT(transport->bytes().total(), 8);
  }
}

TEST(ClosedOperator, BlocksAreRightOnEveryRoom) {
  const FormFactors F = rooms_with_kernel(block_kernel(3, 25, 0.01, 3));
  const Rooms rooms = find_rooms(F);
  ASSERT_EQ(rooms.count, 3);
  for (Index i = 0; i < 75; ++i) EXPECT_EQ(rooms.of_patch[static_cast<std::size_t>(i)], i / 25);
  const Eigen::MatrixXd P = rooms.indicators(F.mesh->area.cwiseSqrt());
  const Eigen::MatrixXd wanted = materialize(*F.kernel) * P;
  const auto error_with = [&](const std::string& keys) {
    Field images(75, 3);
    const auto transport = closed(F, keys);
    dynamic_cast<const KernelOperator&>(*transport).apply_kernel(P, images);
    return (images - wanted).norm() / wanted.norm();
  };
  EXPECT_LT(error_with("closure=blocks"), 1e-14);
  EXPECT_LT(error_with("closure=blocks,blocks=12"), 1e-14);
  EXPECT_LT(error_with("closure=automatic"), 1e-14);
  // One vector for all rooms is right on the sum of the rooms alone: light leaks from one to the next.
  EXPECT_GT(error_with("closure=symmetric"), 1e-4);
}

TEST(ClosedOperator, SaysWhereScalingDoesNotExist) {
  // K1: two groups that see only each other, of unequal area, approximated with the wrong balance.
  Eigen::MatrixXd kernel = Eigen::MatrixXd::Zero(6, 6);
  kernel.topRightCorner(3, 3).setConstant(0.3);
  kernel.bottomLeftCorner(3, 3).setConstant(0.3);
  const FormFactors F = symmetric_form_factors(kernel, (Eigen::VectorXd(6) << 1, 1, 1, 4, 4, 4).finished(),
                                               Eigen::MatrixXd::Constant(6, 1, 0.95));
  const auto half = closed(F, "closure=symmetric", -0.8);
  EXPECT_NE(half->remark().find("no symmetric scaling"), std::string::npos) << half->remark();
  EXPECT_LE((sums_of(*half) - F.row_sums()).maxCoeff(), 1e-12);  // energy is only removed
  EXPECT_LT(largest_row_error(*closed(F, "closure=blocks,blocks=6", -0.8), F), 1e-13);
}

TEST(ClosedOperator, LeavesIsolatedPatchesIsolated) {
  Eigen::MatrixXd kernel = block_kernel(1, 20, 0, 4);
  kernel.row(7).setZero();
  kernel.col(7).setZero();
  const FormFactors F = rooms_with_kernel(kernel);
  for (const char* keys :
       {"closure=rows", "closure=symmetric", "closure=blocks", "closure=blocks,blocks=5"}) {
    Field light = Field::Zero(20, 1), image(20, 1);
    light(7, 0) = 1;
    const auto transport = closed(F, keys);
    transport->apply(light, image);
    EXPECT_TRUE(image.isZero(0)) << keys;
    transport->apply(Field::Ones(20, 1), image);
    EXPECT_EQ(image(7, 0), 0) << keys;
  }
}

TEST(ClosedOperator, AutomaticClosesWhatIsNotExact) {
  const FormFactors F = rooms_with_kernel(block_kernel(2, 40, 0.01, 5));
  EXPECT_EQ(closed(F, "closure=automatic")->describe(), "wrong:closure=blocks");
  EXPECT_EQ(cpu_operators().make("dense:closure=automatic", F)->describe(), "dense");
  EXPECT_EQ(cpu_operators().make("quantized", F)->describe(),
            "quantized:bits=4,block=32,exact=0.01,diffusion=1,closure=blocks");
  const auto open = cpu_operators().make("quantized:closure=none", F);
  EXPECT_EQ(open->describe(), "quantized:bits=4,block=32,exact=0.01,diffusion=1,closure=none");
  EXPECT_EQ(cpu_operators().make(open->describe(), F)->describe(), open->describe());
}

TEST(ClosedOperator, CertificatesHold) {
  const FormFactors F = rooms_with_kernel(block_kernel(2, 40, 0.01, 6));
  Eigen::MatrixXd T = 0.95 * F.matrix();
  const OperatorReference truth = {{T.cast<long double>()}, 0x1p-53, {}};
  const Eigen::VectorXd root_area = F.mesh->area.cwiseSqrt();
  for (const char* spec : {"quantized:bits=2,closure=none", "quantized:bits=2,closure=symmetric",
                           "quantized:bits=2,closure=blocks", "topk:fraction=0.5,closure=blocks,blocks=8"}) {
    const auto transport = cpu_operators().make(spec, F);
    ASSERT_TRUE(transport->certificate().operator_error) << spec;
    EXPECT_LT(*transport->certificate().operator_error, 1) << spec;
    EXPECT_EQ(check_certificate(*transport, truth, root_area), "") << spec;
  }
  // Blocks may make entries negative, and then row sums bound nothing.
  EXPECT_FALSE(cpu_operators().make("quantized", F)->certificate().spectral_radius_bound);
  EXPECT_TRUE(cpu_operators().make("quantized:closure=symmetric", F)->certificate().spectral_radius_bound);
}

TEST(ClosedOperator, BadKeysAreErrors) {
  const FormFactors F = rooms_with_kernel(block_kernel(1, 8, 0, 1));
  const auto refused = [&](const std::string& spec) {
    try {
      cpu_operators().make(spec, F);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("nothing was thrown");
  };
  EXPECT_EQ(refused("dense:closure=rooms"),
            "'dense:closure=rooms': closure=rooms is none of none, rows, symmetric, blocks, automatic");
  EXPECT_NE(refused("dense:closure=blocks,blocks=0").find("from 1 to 4096"), std::string::npos);
  EXPECT_NE(refused("dense:blocks=3").find("'blocks' is not known"), std::string::npos);
  const FormFactors gathered = unsymmetric_form_factors(block_kernel(1, 8, 0, 1), Eigen::VectorXd::Ones(8),
                                                        Eigen::MatrixXd::Constant(8, 1, 0.5));
  EXPECT_THROW(cpu_operators().make("dense:closure=symmetric", gathered), UsageError);
  EXPECT_NO_THROW(cpu_operators().make("dense:closure=rows", gathered));
}

}  // namespace
}  // namespace radiosity

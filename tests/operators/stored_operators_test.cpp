#include "factorizations/lapack.hpp"
#include "operators/kernel_operator.hpp"
#include "operators/operator_registry.hpp"
#include "tests/conformance/transport_cases.hpp"

#include <gtest/gtest.h>

#include <map>

namespace radiosity {
namespace {

FormFactors room(Index n, Index channels) {
  return symmetric_form_factors(random_kernel(n, 3), Eigen::VectorXd::LinSpaced(n, 1, 2),
                                Eigen::MatrixXd::Constant(n, channels, 0.7));
}

std::map<std::string, std::size_t> bytes_of(const std::string& spec, const FormFactors& form_factors) {
  const ByteCount bytes = cpu_operators().make(spec, form_factors)->bytes();
  std::size_t total = 0;
  for (const auto& part : bytes.parts) total += part.second;
  EXPECT_EQ(bytes.total(), total);
  return {bytes.parts.begin(), bytes.parts.end()};
}

TEST(StoredOperators, BytesFollowFromEntriesAndTypes) {
  const FormFactors form_factors = room(130, 3);
  const std::size_t tiles = 6;  // 3 tile rows
  for (const auto& [spec, size] : {std::pair{"dense", 8u}, {"dense:f32", 4u}, {"dense:f16", 2u}}) {
    const auto bytes = bytes_of(spec, form_factors);
    EXPECT_EQ(bytes.at("entries"), tiles * 4096 * size) << spec;
    EXPECT_EQ(bytes.at("directory"), 4 * 8 + tiles * 4) << spec;
    EXPECT_EQ(bytes.at("diagonals"), 130u * 4 * 8) << spec;
  }
  const Eigen::ArrayXXd kernel = materialize(*form_factors.kernel).array();
  const auto entries = static_cast<std::size_t>((kernel != 0).count());
  std::size_t elements = 0;  // columns of groups of 16 rows
  for (Index first = 0; first < 130; first += 16)
    elements += static_cast<std::size_t>(
        (kernel.middleRows(first, std::min<Index>(16, 130 - first)) != 0).colwise().any().count());
  for (const auto& [spec, size] : {std::pair{"csr", 8u}, {"csr:f32", 4u}}) {
    const auto bytes = bytes_of(spec, form_factors);
    EXPECT_EQ(bytes.at("entries"), entries * size) << spec;
    EXPECT_EQ(bytes.at("indices"), elements * (4 + 2) + 10 * 2 * 8) << spec;
  }
}

TEST(StoredOperators, DenseDoubleSharesTheKernel) {
  const FormFactors form_factors = room(70, 1);
  const auto owners = form_factors.kernel.use_count();
  const auto transport = cpu_operators().make("dense", form_factors);
  EXPECT_EQ(form_factors.kernel.use_count(), owners + 1);
}

TEST(StoredOperators, UnsymmetricFormFactorsGiveAnOperatorThatSaysSo) {
  const Eigen::MatrixXd F = random_kernel(20, 4).triangularView<Eigen::Upper>();
  const FormFactors form_factors =
      unsymmetric_form_factors(F, Eigen::VectorXd::Ones(20), Eigen::MatrixXd::Constant(20, 1, 0.5));
  for (const char* spec : {"dense", "dense:f32", "dense:f16", "csr", "csr:f32"}) {
    const auto transport = cpu_operators().make(spec, form_factors);
    EXPECT_FALSE(transport->symmetric()) << spec;
    EXPECT_EQ(dynamic_cast<KernelOperator*>(transport.get()), nullptr) << spec;
    EXPECT_NE(dynamic_cast<TransposedApply*>(transport.get()), nullptr) << spec;
  }
}

TEST(StoredOperators, CertifyTheSpectralRadiusOfTheirMatrix) {
  const FormFactors form_factors = room(60, 1);
  const Eigen::MatrixXd symmetric = 0.7 * materialize(*form_factors.kernel);
  const double radius = symmetric_eigenpairs(symmetric).values.cwiseAbs().maxCoeff();
  for (const char* spec : {"dense", "dense:f32", "dense:f16", "csr", "csr:f32"}) {
    const Certificate certificate = cpu_operators().make(spec, form_factors)->certificate();
    ASSERT_TRUE(certificate.spectral_radius_bound && certificate.operator_error) << spec;
    EXPECT_GE(*certificate.spectral_radius_bound, radius * (1 - 1e-3)) << spec;
    EXPECT_LE(*certificate.spectral_radius_bound, 1.5 * radius) << spec;
    EXPECT_EQ(certificate.method, "proved");
  }
}

TEST(StoredOperators, CertifyRoundingByTheirStorage) {
  const FormFactors form_factors = room(60, 1);
  const auto error = [&](const char* spec) {
    return *cpu_operators().make(spec, form_factors)->certificate().operator_error;
  };
  EXPECT_LT(error("dense"), 1e-13);
  EXPECT_GT(error("dense:f32"), 0x1p-24);
  EXPECT_LT(error("dense:f32"), 1e-5);
  EXPECT_GT(error("dense:f16"), 0x1p-11);
  EXPECT_LT(error("dense:f16"), 1e-3);
}

TEST(StoredOperators, DoNotClaimWhatASignedKernelDoesNotGive) {
  Eigen::MatrixXd kernel = random_kernel(10, 5);
  kernel(2, 3) = kernel(3, 2) = -0.1;
  const FormFactors form_factors =
      symmetric_form_factors(kernel, Eigen::VectorXd::Ones(10), Eigen::MatrixXd::Constant(10, 1, 0.5));
  const Certificate certificate = cpu_operators().make("dense:f32", form_factors)->certificate();
  EXPECT_TRUE(certificate.spectral_radius_bound.has_value());
  EXPECT_FALSE(certificate.operator_error.has_value());
}

}  // namespace
}  // namespace radiosity

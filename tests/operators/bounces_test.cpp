// Document 000, Sections 3.3 to 3.5: sums of bounces and their compressed matrices.

#include "form_factors/exact_rooms.hpp"
#include "foundation/error.hpp"
#include "operators/operator_registry.hpp"

#include <gtest/gtest.h>

namespace radiosity {
namespace {

using Eigen::MatrixXd;

/// A closed room in three colours; the last three patches are black in red.
FormFactors coloured_room() {
  exact_rooms::Room room = exact_rooms::closed_room(64, 3, 0.7);
  FormFactors form_factors = exact_rooms::form_factors_of(room);
  auto mesh = std::make_shared<PatchMesh>(*form_factors.mesh);
  mesh->reflectance = MatrixXd(64, 3);
  for (Index i = 0; i < 64; ++i)
    mesh->reflectance.row(i) << 0.8 - 0.01 * static_cast<double>(i % 9), 0.5, 0.2;
  mesh->reflectance.col(0).tail(3).setZero();
  mesh->emission = MatrixXd::Ones(64, 3);
  form_factors.mesh = mesh;
  return form_factors;
}

MatrixXd neumann(const FormFactors& form_factors, const MatrixXd& E, int bounces) {
  const MatrixXd F = form_factors.matrix();
  MatrixXd B = E;
  for (int h = 0; h < bounces; ++h) B = (E + form_factors.mesh->reflectance.cwiseProduct(F * B)).eval();
  return B;
}

MatrixXd answer(const std::string& spec, const FormFactors& form_factors, const MatrixXd& E) {
  MatrixXd B(E.rows(), E.cols());
  cpu_operators().make(spec, form_factors)->apply(E, B);
  return B;
}

TEST(Bounces, AreNeumannStepsInRadiosity) {
  const FormFactors F = coloured_room();
  const MatrixXd E = exact_rooms::random_lights(64, 3, 5);
  for (const int k : {1, 2, 3, 7, 8, 20}) {
    const MatrixXd expected = neumann(F, E, k);
    const std::string spec = "bounces:k=" + std::to_string(k) + ",storage=";
    EXPECT_LE((answer(spec + "f64", F, E) - expected).norm(), 1e-13 * expected.norm()) << k;
    EXPECT_LE((answer(spec + "f32", F, E) - expected).norm(), 1e-6 * expected.norm()) << k;
    EXPECT_LE((answer(spec + "f16", F, E) - expected).norm(), 1e-3 * expected.norm()) << k;
    // One bounce more would be seen.
    EXPECT_GT((answer(spec + "f64", F, E) - neumann(F, E, k + 1)).norm(), 1e-6 * expected.norm()) << k;
  }
  const MatrixXd all = neumann(F, E, 400);
  EXPECT_LE((answer("bounces:k=inf,storage=f64", F, E) - all).norm(), 1e-12 * all.norm());
}

TEST(Bounces, GiveTheDocumentsIrradianceOfBlackEmittersToo) {
  // F sum over h < k of T^h E is what arrives; Eq. 2 would drop light that starts at a black patch.
  const FormFactors form_factors = coloured_room();
  MatrixXd E = MatrixXd::Zero(64, 3);
  E.row(62).setOnes();  // black in red
  const MatrixXd irradiance = form_factors.matrix() * neumann(form_factors, E, 2);
  const MatrixXd reflected = answer("bounces:k=3,storage=f64", form_factors, E) - E;
  for (Index i = 0; i < 61; ++i)
    for (Index c = 0; c < 3; ++c)
      EXPECT_NEAR(reflected(i, c) / form_factors.mesh->reflectance(i, c), irradiance(i, c),
                  1e-13 * irradiance.maxCoeff());
  EXPECT_GT(irradiance.col(0).maxCoeff(), 0);
}

TEST(Bounces, KnowTheirTranspose) {
  const FormFactors F = coloured_room();
  const MatrixXd X = exact_rooms::random_lights(64, 3, 6), Y = exact_rooms::random_lights(64, 3, 7);
  for (const std::string spec : {"bounces:k=3,storage=f64", "dxt:bounces=3", "dxt:codec=bc4"}) {
    const auto transport = cpu_operators().make(spec, F);
    MatrixXd image(64, 3), back(64, 3);
    transport->apply(X, image);
    dynamic_cast<const TransposedApply&>(*transport).apply_transposed(1, Y, 0, back);
    for (Index c = 0; c < 3; ++c)
      EXPECT_NEAR(image.col(c).dot(Y.col(c)), X.col(c).dot(back.col(c)),
                  1e-5 * image.col(c).norm() * Y.col(c).norm())
          << spec;
  }
}

TEST(Bounces, RefuseSumsThatDoNotExist) {
  const FormFactors bright = exact_rooms::form_factors_of(exact_rooms::closed_room(40, 3, 1.0));
  EXPECT_THROW(cpu_operators().make("bounces:k=inf", bright), Error);
  EXPECT_NO_THROW(cpu_operators().make("bounces:k=5", bright));
  for (const std::string spec :
       {"bounces:k=0", "bounces:k=1001", "bounces:k=three", "bounces:storage=f8", "dxt:bounces=0",
        "dxt:codec=bc7", "dxt:range=100", "dxt:range=wide", "dxt:exact=2", "dxt:reorder=hilbert",
        "dxt:matrix=kernel,codec=bc1", "dxt:matrix=kernel,bounces=3", "dxt:bounces=3,closure=rows"})
    EXPECT_THROW(cpu_operators().make(spec, bright), UsageError) << spec;
}

TEST(Dxt, CompressesTheSumOfBouncesToo) {
  const FormFactors F = coloured_room();
  const MatrixXd E = exact_rooms::random_lights(64, 3, 8);
  const MatrixXd expected = neumann(F, E, 3);
  const double document = (answer("dxt:bounces=3", F, E) - expected).norm() / expected.norm();
  const double better =
      (answer("dxt:bounces=3,range=auto,fill=1,fit=cluster,reorder=2opt", F, E) - expected).norm() /
      expected.norm();
  EXPECT_LE(document, 0.3);
  EXPECT_LE(better, 0.5 * document);
  EXPECT_GT((answer("dxt:bounces=2,exact=1", F, E) - expected).norm(), 1e-3 * expected.norm());
  EXPECT_LE((answer("dxt:bounces=3,exact=1,fill=1", F, E) - expected).norm(), 1e-5 * expected.norm());
}

TEST(Dxt, RowsAreClosedInEveryChannel) {
  const FormFactors F = coloured_room();
  const auto worst_row = [&](const std::string& spec) {
    const MatrixXd sums = answer(spec, F, MatrixXd::Ones(64, 3));
    const MatrixXd truth = F.mesh->reflectance.cwiseProduct(F.row_sums().replicate(1, 3));
    return (sums - truth).cwiseAbs().maxCoeff();
  };
  EXPECT_GT(worst_row("dxt"), 1e-3);
  EXPECT_LE(worst_row("dxt:closure=rows"), 1e-6);
  EXPECT_GT(worst_row("dxt:matrix=kernel,exact=0"), 1e-4);
  EXPECT_LE(worst_row("dxt:matrix=kernel,exact=0,closure=symmetric"), 1e-6);
}

TEST(Dxt, TakesTheBytesOfTheDocument) {
  // 4 bits a texel of three channels, and 3 x 4 % of the entries with 4 + 2 bytes.
  exact_rooms::Room room = exact_rooms::closed_room(640, 3, 0.7);
  FormFactors form_factors = exact_rooms::form_factors_of(room);
  auto mesh = std::make_shared<PatchMesh>(*form_factors.mesh);
  mesh->reflectance = MatrixXd::Constant(640, 3, 0.5);
  mesh->emission = MatrixXd::Ones(640, 3);
  form_factors.mesh = mesh;
  const ByteCount bytes = cpu_operators().make("dxt:reorder=none", form_factors)->bytes();
  double texture = 0;
  for (const auto& [part, count] : bytes.parts)
    if (part == "texels" || part == "exact" || part == "indices") texture += static_cast<double>(count);
  EXPECT_NEAR(texture / (640.0 * 640.0), 1.22, 0.05 * 1.22);
}

}  // namespace
}  // namespace radiosity

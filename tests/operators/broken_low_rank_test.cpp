// Each operator of low rank is held to what defines it, and a broken variant of each fails that.

#include "factorizations/lapack.hpp"
#include "form_factors/exact_rooms.hpp"
#include "operators/global_operator.hpp"
#include "operators/low_rank_operator.hpp"
#include "operators/operator_registry.hpp"
#include "scene/built_in.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <memory>

namespace radiosity {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double tolerance = 1e-9;

/// F = U V'.
struct Factors {
  MatrixXd U, V;

  MatrixXd product() const { return U * V.transpose(); }
};

Factors factors_of(const LinearOperator& transport) {
  const auto& factors = dynamic_cast<const LowRankFactors&>(transport);
  Factors result{MatrixXd(transport.size(), factors.rank()), MatrixXd()};
  factors.multiply_left(MatrixXd::Identity(factors.rank(), factors.rank()), result.U);
  MatrixXd right(factors.rank(), transport.size());
  factors.multiply_right_transposed(MatrixXd::Identity(transport.size(), transport.size()), right);
  result.V = right.transpose();
  return result;
}

MatrixXd orthonormal(const MatrixXd& X) {
  return orthonormal_columns(X);
}

/// How far factors are from what defines their method, relative to F.
using Definition = std::function<double(const MatrixXd& F, const Factors& factors)>;

/// The best of their rank.
double beyond_the_best(const MatrixXd& F, const Factors& factors) {
  const VectorXd sigma = singular_value_decomposition(F).values;
  const double best = sigma.tail(sigma.size() - factors.U.cols()).norm();
  return ((F - factors.product()).norm() - best) / F.norm();
}

/// F projected on the columns of U.
double beside_the_projection(const MatrixXd& F, const Factors& factors) {
  const MatrixXd Q = orthonormal(factors.U);
  return (factors.product() - Q * (Q.transpose() * F)).norm() / F.norm();
}

/// F projected on the columns of V, from the right.
double beside_the_right_projection(const MatrixXd& F, const Factors& factors) {
  const MatrixXd W = orthonormal(factors.V);
  return (factors.product() - F * W * W.transpose()).norm() / F.norm();
}

/// F projected on the columns of U and the rows of V'.
double beside_both_projections(const MatrixXd& F, const Factors& factors) {
  const MatrixXd Q = orthonormal(factors.U), W = orthonormal(factors.V);
  return (factors.product() - Q * (Q.transpose() * F * W) * W.transpose()).norm() / F.norm();
}

void drop_a_column(Factors& factors) {
  factors.U.rightCols(1).setZero();
}

void forget_the_order(Factors& factors) {
  factors.V = MatrixXd(factors.V.colwise().reverse());
}

void halve(Factors& factors) {
  factors.U *= 0.5;
}

struct Method {
  std::string spec;
  Definition definition;
  std::function<void(Factors&)> fault;
  double allowed = tolerance;
};

TEST(BrokenLowRank, FailsWhatDefinesEachMethod) {
  const exact_rooms::Room room = exact_rooms::closed_room(60, 4, 0.7);
  const FormFactors form_factors = exact_rooms::form_factors_of(room);
  const MatrixXd F = form_factors.matrix();
  const std::vector<Method> methods = {
      {"svd", beyond_the_best, drop_a_column},
      {"svd:method=lanczos", beyond_the_best, forget_the_order},
      {"rsvd", beyond_the_best, halve, 1e-2},
      {"qr", beside_the_projection, halve},
      {"qr:columns=pivoted", beside_the_projection, forget_the_order},
      {"cur:core=projection", beside_both_projections, halve},
      {"wavelet", beside_the_right_projection, forget_the_order},
      {"dct", beside_the_right_projection, halve},
  };
  for (const Method& method : methods) {
    const std::string keys = method.spec.find(':') == std::string::npos ? ":" : ",";
    const auto transport = cpu_operators().make(method.spec + keys + "k=12,storage=f64", form_factors);
    Factors factors = factors_of(*transport);
    EXPECT_LE(std::abs(method.definition(F, factors)), method.allowed) << method.spec;
    method.fault(factors);
    EXPECT_GT(std::abs(method.definition(F, factors)), 2 * method.allowed) << method.spec;
  }
}

/// Means over patches of unequal elements; V names the patch of each element and its area.
MatrixXd patch_means(const Factors& factors) {
  const MatrixXd indicator = (factors.V.array() > 0).cast<double>();
  const VectorXd sums = factors.V.colwise().sum();
  return indicator * sums.cwiseInverse().asDiagonal() * factors.V.transpose();
}

TEST(BrokenLowRank, TwoMeshesThatForgetAreasFail) {
  SilentMonitor monitor;
  const FormFactors form_factors = compute_form_factors(
      std::make_shared<const PatchMesh>(make_patches(built_in_scene("clutter"), {.patches = 300})), {},
      monitor);
  const MatrixXd F = form_factors.matrix();
  for (const std::string spec : {"2msc:k=90", "sparse-v:k=90"}) {
    Factors factors = factors_of(*cpu_operators().make(spec + ",mesh=uniform,storage=f64", form_factors));
    const MatrixXd P = patch_means(factors);
    ASSERT_LE((P * P - P).norm(), tolerance * P.norm()) << spec;
    EXPECT_LE((factors.product() - F * P).norm(), tolerance * F.norm()) << spec;
    const double mean_area = form_factors.mesh->area.mean();
    factors.V = (factors.V.array() > 0).cast<double>() * mean_area;
    EXPECT_GT((factors.product() - F * P).norm(), 1e-2 * F.norm()) << spec << " that takes areas for equal";
  }
  const auto two_sided = cpu_operators().make("2msc:k=90,mesh=uniform,sides=two,storage=f64", form_factors);
  const MatrixXd P =
      patch_means(factors_of(*cpu_operators().make("2msc:k=90,mesh=uniform,storage=f64", form_factors)));
  const MatrixXd exact = P * F + F * P - P * F * P;
  const MatrixXd product = factors_of(*two_sided).product();
  EXPECT_LE((product - exact).norm(), tolerance * F.norm());
  EXPECT_GT((product - (P * F + F * P)).norm(), 1e-2 * F.norm()) << "what is on both sides counts once";
}

TEST(BrokenLowRank, GlobalOperatorsOfAnotherSignFail) {
  const exact_rooms::Room room = exact_rooms::closed_room(60, 4, 0.7);
  const FormFactors form_factors = exact_rooms::form_factors_of(room);
  const MatrixXd E = exact_rooms::random_lights(60, 2, 5);
  const auto transport = cpu_operators().make("svd:k=20,storage=f64", form_factors);
  const auto residual = [&](const LinearOperator& global) {
    MatrixXd B(60, 2), image(60, 2);
    global.apply(E, B);
    transport->apply(B, image);
    return (E + image - B).norm() / E.norm();
  };
  EXPECT_LE(residual(*cpu_operators().make("svd:k=20,storage=f64,global=1", form_factors)), tolerance);
  // U with its sign changed: the Y of document 004, Eq. 5, used as ours.
  Factors factors = factors_of(*transport);
  const GlobalOperator wrong(
      std::make_unique<LowRankOperator<double>>(form_factors, -factors.U, factors.V, "wrong-sign"));
  EXPECT_GT(residual(wrong), 0.1);
}

TEST(BrokenLowRank, NeumannSparseThatStopsEarlyFails) {
  const exact_rooms::Room room = exact_rooms::closed_room(60, 4, 0.7);
  const FormFactors form_factors = exact_rooms::form_factors_of(room);
  const auto error = [&](const std::string& keys) {
    MatrixXd B(60, 1);
    cpu_operators().make("neumann-sparse:" + keys, form_factors)->apply(MatrixXd::Ones(60, 1), B);
    return (B.array() * (1 - 0.7) - 1).abs().maxCoeff();
  };
  EXPECT_LE(error("threshold=0"), 1e-5);
  EXPECT_GT(error("threshold=0,bounces=5"), 1e-2);
}

}  // namespace
}  // namespace radiosity

#include "hard_matrices.hpp"

#include "factorizations/lapack.hpp"
#include "foundation/random.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace radiosity::testing {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

MatrixXd random_orthogonal(Index n, Index columns, std::uint64_t seed) {
  RandomStream random(seed);
  MatrixXd numbers(n, columns);
  for (Index k = 0; k < numbers.size(); ++k) numbers(k) = random.uniform(-1, 1);
  return pivoted_qr(numbers).Q;
}

VectorXd log_random(Index n, double condition, std::uint64_t seed) {
  RandomStream random(seed);
  VectorXd values(n);
  for (double& value : values) value = std::pow(condition, -random.uniform());
  std::sort(values.begin(), values.end(), std::greater<>());
  return values;
}

VectorXd step(Index n, double low) {
  VectorXd values = VectorXd::Constant(n, low);
  values.head(n / 3).setOnes();
  return values;
}

MatrixXd kahan(Index n) {
  const double sine = std::sin(1.2), cosine = std::cos(1.2);
  MatrixXd matrix = MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i) {
    matrix(i, i) = std::pow(sine, static_cast<double>(i));
    for (Index j = i + 1; j < n; ++j) matrix(i, j) = -cosine * matrix(i, i);
  }
  return matrix;
}

}  // namespace

VectorXd geometric_values(Index n, double condition) {
  VectorXd values(n);
  for (Index k = 0; k < n; ++k)
    values[k] =
        std::pow(condition, -static_cast<double>(k) / std::max<double>(1, static_cast<double>(n - 1)));
  return values;
}

MatrixXd matrix_with_values(Index rows, Index columns, const VectorXd& values, std::uint64_t seed) {
  const Index rank = values.size();
  return random_orthogonal(rows, rank, seed) * values.asDiagonal() *
         random_orthogonal(columns, rank, seed + 1).transpose();
}

std::vector<HardMatrix> hard_matrices(std::uint64_t seed) {
  std::vector<HardMatrix> all;
  const auto add = [&](const std::string& name, Index rows, Index columns, const VectorXd& values) {
    all.push_back({name, matrix_with_values(rows, columns, values, seed + 17 * all.size()), values});
  };
  for (const double condition : {2.0, 1e8, 1e15}) {
    add("geometric, condition " + std::to_string(condition), 60, 60, geometric_values(60, condition));
    add("log-random, condition " + std::to_string(condition), 70, 50, log_random(50, condition, seed + 3));
    add("arithmetic, condition " + std::to_string(condition), 50, 70,
        VectorXd::LinSpaced(50, 1, 1 / condition));
  }
  add("step", 60, 60, step(60, 1e-6));
  add("scaled up", 60, 40, 1e150 * geometric_values(40, 1e8));
  add("scaled down", 40, 60, 1e-150 * geometric_values(40, 1e8));
  VectorXd deficient = geometric_values(40, 1e3);
  deficient.tail(25).setZero();
  add("rank deficient", 60, 40, deficient);
  all.push_back({"zero", MatrixXd::Zero(30, 20), VectorXd::Zero(20)});
  all.push_back({"identity", MatrixXd::Identity(40, 40), VectorXd::Ones(40)});
  all.push_back({"Kahan", kahan(60), {}});
  return all;
}

}  // namespace radiosity::testing

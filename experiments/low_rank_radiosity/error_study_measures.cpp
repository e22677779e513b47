#include "experiments/low_rank_radiosity/error_study_measures.hpp"

#include "experiments/reference_solution.hpp"
#include "factorizations/lapack.hpp"
#include "foundation/error.hpp"
#include "operators/low_rank_operator.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace radiosity {
namespace {

/// Mean over the lights of each kind; empty for kinds that the set lacks.
std::array<std::optional<double>, 3> means_of_kinds(const LightSet& set, const std::vector<double>& errors) {
  std::array<std::optional<double>, 3> means;
  for (std::size_t kind = 0; kind < means.size(); ++kind) {
    std::vector<double> chosen;
    for (std::size_t light = 0; light < set.lights.size(); ++light)
      if (static_cast<std::size_t>(set.lights[light].kind) == kind) chosen.push_back(errors[light]);
    if (!chosen.empty()) means[kind] = mean_of(chosen);
  }
  return means;
}

}  // namespace

double mean_of(const std::vector<double>& values) {
  return values.empty()
             ? 0
             : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

LowRankParts LowRankParts::leading(Index k) const {
  const Index rank = std::min(k, U.cols());
  return {U.leftCols(rank), V.leftCols(rank),
          column_bytes / static_cast<std::size_t>(U.cols()) * static_cast<std::size_t>(rank), other_bytes};
}

LowRankParts low_rank_parts(const OperatorRegistry& operators, const std::string& spec,
                            const FormFactors& form_factors) {
  const auto transport = operators.make(spec, form_factors);
  const auto* factors = dynamic_cast<const LowRankFactors*>(transport.get());
  if (factors == nullptr)
    fail<UsageError>("'{}' has no factors of low rank to study: name an operator such as svd:k=64", spec);
  const Index n = transport->size();
  const Index rank = factors->rank();
  LowRankParts parts{Field(n, rank), Field(n, rank), 0, 0};
  factors->multiply_left(Field::Identity(rank, rank), parts.U);
  constexpr Index rows_together = 256;
  for (Index first = 0; first < n; first += rows_together) {
    const Index rows = std::min(rows_together, n - first);
    Field units = Field::Zero(n, rows);
    units.middleRows(first, rows).setIdentity();
    Field columns(rank, rows);
    factors->multiply_right_transposed(units, columns);
    parts.V.middleRows(first, rows) = columns.transpose();
  }
  for (const auto& [part, bytes] : transport->bytes().parts)
    (part == "diagonals" ? parts.other_bytes : parts.column_bytes) += bytes;
  return parts;
}

Eigen::VectorXd squared_row_errors(const Eigen::MatrixXd& kernel, const Eigen::VectorXd& area,
                                   const LowRankParts& parts) {
  const Eigen::VectorXd root_area = area.cwiseSqrt();
  const Eigen::MatrixXd left = root_area.asDiagonal() * parts.U;
  const Eigen::MatrixXd right = root_area.cwiseInverse().asDiagonal() * parts.V;
  Eigen::MatrixXd difference = kernel;
  difference.noalias() -= left * right.transpose();
  return difference.rowwise().squaredNorm();
}

double relative_operator_error(const Eigen::MatrixXd& reflectance, const Eigen::VectorXd& difference_rows,
                               const Eigen::VectorXd& kernel_rows) {
  const Eigen::VectorXd weights = reflectance.rowwise().squaredNorm();
  const double exact = weights.dot(kernel_rows);
  return exact > 0 ? std::sqrt(weights.dot(difference_rows) / exact) : 0;
}

Field solve_densely(const Eigen::MatrixXd& kernel, const PatchMesh& mesh, const Field& emission) {
  const Eigen::VectorXd root_area = mesh.area.cwiseSqrt();
  Field radiosity(emission.rows(), emission.cols());
  for (Index channel = 0; channel < mesh.channels(); ++channel) {
    const auto columns = Eigen::seq(channel, Eigen::last, mesh.channels());
    const LuFactors factors(Eigen::MatrixXd::Identity(kernel.rows(), kernel.rows()) -
                            mesh.reflectance.col(channel).asDiagonal() * kernel);
    radiosity(Eigen::all, columns) = root_area.cwiseInverse().asDiagonal() *
                                     factors.solve(root_area.asDiagonal() * emission(Eigen::all, columns));
  }
  return radiosity;
}

LightErrors light_errors(const PatchMesh& mesh, const LightSet& set, const Field& radiosity,
                         const Field& approximation) {
  const std::vector<double> of_radiosity = relative_errors(mesh, approximation, radiosity);
  const std::vector<double> of_indirect =
      relative_errors(mesh, Field(approximation - set.emission), Field(radiosity - set.emission));
  LightErrors errors;
  errors.radiosity_mean = mean_of(of_radiosity);
  for (const double error : of_radiosity)
    errors.radiosity_rms += error * error / static_cast<double>(of_radiosity.size());
  errors.radiosity_rms = std::sqrt(errors.radiosity_rms);
  errors.radiosity_max = *std::max_element(of_radiosity.begin(), of_radiosity.end());
  errors.indirect_mean = mean_of(of_indirect);
  if (!of_indirect.empty()) errors.indirect_max = *std::max_element(of_indirect.begin(), of_indirect.end());
  errors.of_kind = means_of_kinds(set, of_radiosity);
  return errors;
}

}  // namespace radiosity

#include "experiments/dxt_radiosity/bounce_methods.hpp"

#include "kernels/products.hpp"
#include "kernels/row_major_matrix.hpp"
#include "operators/colour_operator.hpp"

#include <memory>
#include <utility>

namespace radiosity {
namespace {

using FloatMatrix = RowMajorMatrix<float>;

/// incident = F exident, or by F^c.
using Gather = std::function<void(const Field& exident, Field& incident)>;

/// Eq. 3 and 4, bounce by bounce, and B as the sum of all that is sent.
void gather_bounces(const Gather& gather, const Eigen::MatrixXd& reflectance, const Field& emission,
                    long bounces, Field& radiosity) {
  radiosity = emission;
  Field exident = emission;
  Field incident(emission.rows(), emission.cols());
  for (long bounce = 0; bounce < bounces; ++bounce) {
    gather(exident, incident);
    for (Index j = 0; j < exident.cols(); ++j)
      exident.col(j) = incident.col(j).cwiseProduct(reflectance.col(j % reflectance.cols()));
    radiosity += exident;
  }
}

BounceMethod gathering(std::string name, std::size_t matrix_bytes, Gather gather,
                       const Eigen::MatrixXd& reflectance, long bounces) {
  const std::size_t bytes = matrix_bytes + static_cast<std::size_t>(reflectance.size()) * sizeof(double);
  return {std::move(name), bytes,
          [gather = std::move(gather), reflectance, bounces](const Field& emission, Field& radiosity) {
            gather_bounces(gather, reflectance, emission, bounces, radiosity);
          }};
}

}  // namespace

BounceMethod naive_method(const FormFactors& form_factors, long bounces) {
  const auto F = std::make_shared<const FloatMatrix>(form_factors.matrix());
  const auto gather = [F](const Field& exident, Field& incident) {
    for (Index j = 0; j < exident.cols(); ++j) multiply(*F, exident.col(j), incident.col(j));
  };
  return gathering("naive", F->entry_bytes(), gather, form_factors.mesh->reflectance, bounces);
}

BounceMethod packed_method(const FormFactors& form_factors, long bounces) {
  const auto F = std::make_shared<const FloatMatrix>(form_factors.matrix());
  const auto gather = [F](const Field& exident, Field& incident) { multiply(*F, exident, incident); };
  return gathering("packed", F->entry_bytes(), gather, form_factors.mesh->reflectance, bounces);
}

BounceMethod colour_method(const FormFactors& form_factors, long bounces) {
  const Eigen::MatrixXd F = form_factors.matrix();
  const Eigen::MatrixXd colours = sender_colours(form_factors.mesh->reflectance);
  const auto matrices = std::make_shared<std::vector<FloatMatrix>>();
  std::size_t bytes = 0;
  for (Index channel = 0; channel < colours.cols(); ++channel) {
    matrices->emplace_back(Eigen::MatrixXd(F * colours.col(channel).asDiagonal()));
    bytes += matrices->back().entry_bytes();
  }
  // Eq. 7 sends what arrives through F^c; E / colour stands for the light that arrives from outside.
  const auto gather = [matrices, colours](const Field& exident, Field& incident) {
    const auto channels = static_cast<Index>(matrices->size());
    for (Index j = 0; j < exident.cols(); ++j)
      multiply((*matrices)[static_cast<std::size_t>(j % channels)],
               exident.col(j).cwiseQuotient(colours.col(j % channels)), incident.col(j));
  };
  return gathering("colour", bytes, gather, form_factors.mesh->reflectance, bounces);
}

BounceMethod summed_method(const std::string& name, const std::string& spec, const FormFactors& form_factors,
                           const OperatorRegistry& operators) {
  const std::shared_ptr<const LinearOperator> sum = operators.make(spec, form_factors);
  return {name, sum->bytes().total(), [sum](const Field& emission, Field& radiosity) {
            radiosity = emission;
            if (sum->global())
              sum->apply(emission, radiosity);
            else
              sum->apply(1, emission, 1, radiosity);
          }};
}

BounceMethod solved_method(const std::string& name, const std::string& spec, double tolerance,
                           const FormFactors& form_factors, const OperatorRegistry& operators,
                           const SolverRegistry& solvers) {
  const std::shared_ptr<const LinearOperator> transport = operators.make(spec, form_factors);
  const std::shared_ptr<Solver> solver = solvers.make("", {.transport = *transport,
                                                           .root_area = form_factors.mesh->area.cwiseSqrt(),
                                                           .options = {.tolerance = tolerance}});
  return {name, transport->bytes().total(), [transport, solver](const Field& emission, Field& radiosity) {
            radiosity = solve(*solver, emission);
          }};
}

}  // namespace radiosity

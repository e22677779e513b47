#include "experiments/low_rank_radiosity/best_rank.hpp"

#include "factorizations/lapack.hpp"
#include "foundation/error.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

/// A^{1/2} (B - E) of one channel, a column a light.
Eigen::MatrixXd indirect_light(const SolvedLights& lights, const Eigen::VectorXd& root_area, Index channel,
                               Index channels) {
  const Index count = lights.emission.cols() / channels;
  Eigen::MatrixXd indirect(lights.emission.rows(), count);
  for (Index light = 0; light < count; ++light) {
    const Index column = light * channels + channel;
    indirect.col(light) = root_area.cwiseProduct(lights.radiosity.col(column) - lights.emission.col(column));
  }
  return indirect;
}

/// sqrt(probability) / ||B||_A, the channels of a light taken together.
Eigen::VectorXd weights_of_lights(const PatchMesh& mesh, const SolvedLights& lights,
                                  const Eigen::VectorXd& probability) {
  const Eigen::VectorXd root_area = mesh.area.cwiseSqrt();
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(lights.count(mesh));
  for (Index light = 0; light < weights.size(); ++light) {
    const double size =
        (root_area.asDiagonal() * lights.radiosity.middleCols(light * mesh.channels(), mesh.channels()))
            .norm();
    if (size > 0) weights[light] = std::sqrt(probability[light]) / size;
  }
  return weights;
}

/// Left singular vectors, the leading ones first. Of a wide X as eigenvectors of X X': directions whose
/// singular value is below 1e-8 of the largest are lost in rounding, far below the errors that are drawn.
Eigen::MatrixXd leading_directions(const Eigen::MatrixXd& X) {
  if (X.cols() < X.rows()) return singular_value_decomposition(X).U;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(X.rows(), X.rows());
  gram.selfadjointView<Eigen::Lower>().rankUpdate(X);
  return symmetric_eigenpairs(std::move(gram)).vectors.rowwise().reverse();
}

}  // namespace

SolvedLights SolvedLights::part(const PatchMesh& mesh, Index first, Index count) const {
  const Index channels = mesh.channels();
  return {emission.middleCols(first * channels, count * channels),
          radiosity.middleCols(first * channels, count * channels)};
}

BestRank::BestRank(const PatchMesh& mesh, const SolvedLights& lights, const Eigen::VectorXd& probability)
    : root_area_(mesh.area.cwiseSqrt()) {
  if (lights.emission.rows() != mesh.patch_count() || lights.radiosity.rows() != mesh.patch_count() ||
      lights.emission.cols() != lights.radiosity.cols() || probability.size() != lights.count(mesh))
    fail<UsageError>(
        "{} lights on {} patches cannot be told apart in {} x {} emissions and {} x {} radiosities.",
        probability.size(), mesh.patch_count(), lights.emission.rows(), lights.emission.cols(),
        lights.radiosity.rows(), lights.radiosity.cols());
  const Eigen::VectorXd weights = weights_of_lights(mesh, lights, probability);
  for (Index channel = 0; channel < mesh.channels(); ++channel)
    directions_.push_back(leading_directions(indirect_light(lights, root_area_, channel, mesh.channels()) *
                                             weights.asDiagonal()));
}

Field BestRank::radiosity(Index k, const SolvedLights& lights) const {
  const auto channels = static_cast<Index>(directions_.size());
  Field nearest = lights.emission;
  for (Index channel = 0; channel < channels; ++channel) {
    const Eigen::MatrixXd& directions = directions_[static_cast<std::size_t>(channel)];
    const auto leading = directions.leftCols(std::min(k, directions.cols()));
    const Eigen::MatrixXd projected =
        leading * (leading.transpose() * indirect_light(lights, root_area_, channel, channels)).eval();
    for (Index light = 0; light < projected.cols(); ++light)
      nearest.col(light * channels + channel) += projected.col(light).cwiseQuotient(root_area_);
  }
  return nearest;
}

}  // namespace radiosity

#include "render/reference_comparison.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

/// Sums over patches from which means and their standard errors follow.
struct Sums {
  double area = 0;
  double reference = 0;   // sum of A rho H over channels
  double difference = 0;  // sum of A (B - E - rho H)
  Eigen::RowVectorXd variance;

  explicit Sums(Index channels) : variance(Eigen::RowVectorXd::Zero(channels)) {}
  double standard_error() const { return variance.cwiseSqrt().sum(); }
};

/// Area-weighted mean squares over patches and channels, and what noise does to them.
struct MeanSquares {
  double difference = 0;      // of the difference, with the noise in it
  double noise = 0;           // of the noise
  double standard_error = 0;  // of difference - noise

  MeanSquares(const PatchMesh& mesh, const Eigen::MatrixXd& differences, const Eigen::MatrixXd& noises) {
    const double weight = mesh.area.sum() * static_cast<double>(noises.cols());
    double variance = 0;
    for (Index i = 0; i < mesh.patch_count(); ++i) {
      double deviation = 0;
      for (Index c = 0; c < noises.cols(); ++c) {
        const double square = std::pow(differences(i, c), 2);
        const double expected = std::pow(noises(i, c), 2);
        difference += mesh.area[i] * square / weight;
        noise += mesh.area[i] * expected / weight;
        // (d + s z)^2 with standard normal z has the variance 4 d^2 s^2 + 2 s^4.
        const double true_square = std::max(0.0, square - expected);
        deviation += std::sqrt(4 * true_square * expected + 2 * expected * expected);
      }
      variance += std::pow(mesh.area[i] * deviation / weight, 2);
    }
    standard_error = std::sqrt(variance);
  }
};

}  // namespace

ReferenceComparison compare_with_reference(const PatchMesh& mesh, const Eigen::MatrixXd& B,
                                           const PathTracedIrradiance& reference) {
  const Index channels = mesh.channels();
  if (B.rows() != mesh.patch_count() || B.cols() != channels || reference.irradiance.rows() != B.rows() ||
      reference.irradiance.cols() != B.cols())
    fail<UsageError>(
        "a radiosity of {} x {} and a reference of {} x {} cannot be compared; both must be {} x {}",
        B.rows(), B.cols(), reference.irradiance.rows(), reference.irradiance.cols(), mesh.patch_count(),
        channels);
  const Eigen::MatrixXd reflected = mesh.reflectance.cwiseProduct(reference.irradiance);
  const Eigen::MatrixXd noise = mesh.reflectance.cwiseProduct(reference.standard_error);
  const Eigen::MatrixXd difference = B - mesh.emission - reflected;

  int group_count = mesh.scene ? static_cast<int>(mesh.scene->groups.size()) : 0;
  for (const Patch& patch : mesh.patches) group_count = std::max(group_count, patch.group + 1);
  Sums whole(channels);
  std::vector<Sums> groups(static_cast<std::size_t>(group_count), Sums(channels));
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const auto group = static_cast<std::size_t>(mesh.patches[static_cast<std::size_t>(i)].group);
    for (Sums* sums : {&whole, &groups[group]}) {
      sums->area += mesh.area[i];
      sums->reference += mesh.area[i] * reflected.row(i).sum();
      sums->difference += mesh.area[i] * difference.row(i).sum();
      sums->variance += (mesh.area[i] * noise.row(i)).cwiseAbs2();
    }
  }
  if (!(whole.reference > 0))
    fail("the path tracer found no reflected light to compare with; does the scene emit, and reflect?");

  ReferenceComparison result;
  result.mean_difference = whole.difference / whole.reference;
  result.mean_difference_standard_error = whole.standard_error() / whole.reference;
  const double mean = whole.reference / (whole.area * static_cast<double>(channels));
  const MeanSquares squares(mesh, difference, noise);
  const double true_square = std::max(0.0, squares.difference - squares.noise);
  result.rms_difference = std::sqrt(true_square) / mean;
  // The error of a square root; near zero, where it has no slope, how far the square may reach.
  result.rms_difference_standard_error =
      (std::sqrt(true_square + squares.standard_error) - std::sqrt(true_square)) / mean;
  result.rms_standard_error = std::sqrt(squares.noise) / mean;
  result.beyond_four_standard_errors =
      static_cast<double>((difference.array().abs() > 4 * noise.array()).count()) /
      static_cast<double>(difference.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (groups[g].area == 0) continue;
    const double group_weight = groups[g].area * static_cast<double>(channels);
    const bool named = mesh.scene && g < mesh.scene->groups.size();
    result.groups.push_back({named ? mesh.scene->groups[g] : std::to_string(g), groups[g].area,
                             groups[g].reference / group_weight, groups[g].difference / group_weight,
                             groups[g].standard_error() / group_weight});
  }
  return result;
}

}  // namespace radiosity

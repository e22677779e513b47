#include "experiments/operator_measures.hpp"

#include "operators/kernel_operator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiosity {

namespace {

constexpr Index tile_width = SymmetricTiles<double>::tile_size;

/// Columns first ... first + width - 1 of A^{1/2} F A^{-1/2}, which is K where F is symmetric.
Eigen::MatrixXd exact_columns(const FormFactors& form_factors, Index first, Index width) {
  const Index n = form_factors.patch_count();
  const Eigen::VectorXd root_area = form_factors.mesh->area.cwiseSqrt();
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(n, width);
  if (!form_factors.symmetric()) {
    for (Index i = 0; i < n; ++i)
      for (Index k = 0; k < width; ++k)
        columns(i, k) = root_area[i] / root_area[first + k] * (*form_factors.unsymmetric)(i, first + k);
    return columns;
  }
  const SymmetricTiles<double>& kernel = *form_factors.kernel;
  const Index tile_column = first / tile_width;
  for (Index tile_row = 0; tile_row < kernel.tile_rows(); ++tile_row) {
    const Index tile = kernel.find_tile(std::min(tile_row, tile_column), std::max(tile_row, tile_column));
    if (tile < 0) continue;
    const double* entries = kernel.tile_data(tile);
    const Index height = std::min(tile_width, n - tile_row * tile_width);
    for (Index r = 0; r < height; ++r)
      for (Index k = 0; k < width; ++k)
        columns(tile_row * tile_width + r, k) =
            kernel.scale() *
            (tile_row <= tile_column ? entries[r * tile_width + k] : entries[k * tile_width + r]);
  }
  return columns;
}

/// Squared Frobenius norms, one column of entries at a time.
struct Sums {
  double difference = 0;
  double exact = 0;
  double approximation = 0;

  void add(const Eigen::VectorXd& of_approximation, const Eigen::VectorXd& of_exact) {
    difference += (of_approximation - of_exact).squaredNorm();
    exact += of_exact.squaredNorm();
    approximation += of_approximation.squaredNorm();
  }
};

/// With a kernel under both, one product serves all channels: row i counts (sum over channels of rho_i^2)
/// times.
void add_kernel_block(const KernelOperator& approximation, const Eigen::MatrixXd& exact, Index first,
                      Sums& sums) {
  Field units = Field::Zero(exact.rows(), exact.cols());
  for (Index k = 0; k < units.cols(); ++k) units(first + k, k) = 1;
  Field images(exact.rows(), exact.cols());
  approximation.apply_kernel(units, images);
  const Eigen::VectorXd weights = approximation.reflectance().rowwise().norm();
  for (Index k = 0; k < exact.cols(); ++k)
    sums.add(weights.cwiseProduct(images.col(k)), weights.cwiseProduct(exact.col(k)));
}

void add_general_block(const LinearOperator& approximation, const PatchMesh& mesh,
                       const Eigen::MatrixXd& exact, Index first, Sums& sums) {
  const Index channels = approximation.channels();
  const Eigen::VectorXd root_area = mesh.area.cwiseSqrt();
  Field units = Field::Zero(exact.rows(), exact.cols() * channels);
  for (Index k = 0; k < units.cols(); ++k)
    units(first + k / channels, k) = 1 / root_area[first + k / channels];
  Field images(exact.rows(), units.cols());
  // A unit of b = A^{1/2} B is A^{-1/2} times a unit of B.
  approximation.apply(units, images);
  for (Index k = 0; k < units.cols(); ++k)
    sums.add(root_area.cwiseProduct(images.col(k)),
             mesh.reflectance.col(k % channels).cwiseProduct(exact.col(k / channels)));
}

}  // namespace

std::optional<double> relative_frobenius_error(const LinearOperator& approximation,
                                               const FormFactors& form_factors, Monitor& monitor) {
  const Index n = form_factors.patch_count();
  const auto* kernel = dynamic_cast<const KernelOperator*>(&approximation);
  Sums sums;
  for (Index first = 0; first < n; first += tile_width) {
    monitor.checkpoint("operator error", static_cast<double>(first) / static_cast<double>(n));
    const Eigen::MatrixXd exact = exact_columns(form_factors, first, std::min(tile_width, n - first));
    if (kernel != nullptr)
      add_kernel_block(*kernel, exact, first, sums);
    else
      add_general_block(approximation, *form_factors.mesh, exact, first, sums);
  }
  if (sums.exact > 0) return std::sqrt(sums.difference / sums.exact);
  return sums.approximation == 0 ? std::optional<double>(0) : std::nullopt;
}

std::optional<std::pair<double, double>> row_sum_range(const LinearOperator& transport,
                                                       const FormFactors& form_factors) {
  const Index n = form_factors.patch_count();
  const PatchMesh& mesh = *form_factors.mesh;
  Eigen::VectorXd sums = Eigen::VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN());
  if (const auto* kernel = dynamic_cast<const KernelOperator*>(&transport)) {
    Field images(n, 1);
    kernel->apply_kernel(kernel->root_area(), images);
    sums = images.col(0).cwiseQuotient(kernel->root_area());
  } else {
    Field images(n, transport.channels());
    transport.apply(Field::Ones(n, transport.channels()), images);
    for (Index i = 0; i < n; ++i) {
      Index brightest = 0;
      if (mesh.reflectance.row(i).maxCoeff(&brightest) > 0)
        sums[i] = images(i, brightest) / mesh.reflectance(i, brightest);
    }
  }
  std::optional<std::pair<double, double>> range;
  for (Index i = 0; i < n; ++i) {
    if (form_factors.exposed[i] <= 0 || std::isnan(sums[i])) continue;
    if (!range) range = {sums[i], sums[i]};
    range->first = std::min(range->first, sums[i]);
    range->second = std::max(range->second, sums[i]);
  }
  return range;
}

}  // namespace radiosity

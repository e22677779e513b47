#include "operators/kernel_error.hpp"

#include "foundation/parallel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace radiosity {
namespace {

constexpr Index tile_size = QuantizedTiles::tile_size;

/// What one tile adds to the sums of its 64 rows, and, off the diagonal, of its 64 columns.
struct TileSums {
  using Sums = std::array<double, tile_size>;
  Sums rows[3] = {};  // of the difference's magnitude, of K, of K~
  Sums columns[3] = {};
  double squares = 0;
};

class TileComparison {
 public:
  TileComparison(const SymmetricTiles<double>& K, const QuantizedTiles& approximation,
                 const Eigen::VectorXd& root_area)
      : K_(K), approximation_(approximation), root_area_(root_area) {}

  TileSums compare(Index I, Index tile) const {
    const Index J = K_.tile_column(tile);
    std::array<float, QuantizedTiles::tile_entries> decoded{};
    const Index kept = approximation_.directory().find_tile(I, J);
    if (kept >= 0) approximation_.decode(kept, decoded.data());
    TileSums sums;
    for (Index r = 0; r < std::min(tile_size, K_.size() - I * tile_size); ++r)
      for (Index c = 0; c < std::min(tile_size, K_.size() - J * tile_size); ++c) {
        const double truth = K_.scale() * K_.tile_data(tile)[r * tile_size + c];
        const double approximate =
            approximation_.scale() * entry(decoded, I == J && !approximation_.whole_diagonal(), r, c);
        add(sums, I, J, r, c, {std::fabs(approximate - truth), truth, approximate});
      }
    return sums;
  }

 private:
  static double entry(const std::array<float, QuantizedTiles::tile_entries>& decoded, bool halves, Index r,
                      Index c) {
    const auto at = [&](Index i, Index j) {
      return static_cast<double>(decoded[static_cast<std::size_t>(i * tile_size + j)]);
    };
    return halves ? at(r, c) + at(c, r) : at(r, c);
  }

  void add(TileSums& sums, Index I, Index J, Index r, Index c, const std::array<double, 3>& values) const {
    const auto row = static_cast<std::size_t>(r), column = static_cast<std::size_t>(c);
    sums.squares += (I == J ? 1 : 2) * values[0] * values[0];
    for (std::size_t k = 0; k < 3; ++k) {
      sums.rows[k][row] += values[k] * root_area_[J * tile_size + c];
      if (I != J) sums.columns[k][column] += values[k] * root_area_[I * tile_size + r];
    }
  }

  const SymmetricTiles<double>& K_;
  const QuantizedTiles& approximation_;
  const Eigen::VectorXd& root_area_;
};

}  // namespace

KernelError kernel_error(const SymmetricTiles<double>& K, const QuantizedTiles& approximation,
                         const Eigen::VectorXd& root_area) {
  const TileComparison comparison(K, approximation, root_area);
  std::array<Eigen::VectorXd, 3> sums;
  sums.fill(Eigen::VectorXd::Zero(K.size()));
  double squares = 0;
  std::vector<TileSums> row;
  for (Index I = 0; I < K.tile_rows(); ++I) {
    const Index first = K.row_begin(I);
    row.resize(static_cast<std::size_t>(K.row_begin(I + 1) - first));
    parallel_for(row.size(),
                 [&](std::size_t k) { row[k] = comparison.compare(I, first + static_cast<Index>(k)); });
    for (std::size_t tile = 0; tile < row.size(); ++tile) {
      const Index J = K.tile_column(first + static_cast<Index>(tile));
      squares += row[tile].squares;
      for (std::size_t k = 0; k < 3; ++k) {
        for (Index r = 0; r < std::min(tile_size, K.size() - I * tile_size); ++r)
          sums[k][I * tile_size + r] += row[tile].rows[k][static_cast<std::size_t>(r)];
        for (Index c = 0; c < std::min(tile_size, K.size() - J * tile_size); ++c)
          sums[k][J * tile_size + c] += row[tile].columns[k][static_cast<std::size_t>(c)];
      }
    }
  }
  for (Eigen::VectorXd& sum : sums) sum = sum.cwiseQuotient(root_area);
  const double largest = K.size() == 0 ? 0 : sums[0].maxCoeff();
  return {std::min(std::sqrt(squares), largest), sums[1], sums[2]};
}

Certificate approximation_certificate(const KernelError& error, double rounding,
                                      const Eigen::MatrixXd& reflectance, const Eigen::VectorXd& root_area) {
  constexpr double slack = 1 + 1e-10;  // for rounding of the sums in double
  Certificate certificate;
  certificate.method = "proved";
  double radius = 0, relative = 0;
  const bool empty = root_area.size() == 0;
  const double approximate_norm = empty ? 0 : error.approximate_row_sums.maxCoeff();
  for (Index channel = 0; channel < reflectance.cols() && !empty; ++channel) {
    const Eigen::ArrayXd rho = reflectance.col(channel).array();
    radius = std::max(radius, (rho * error.approximate_row_sums.array()).maxCoeff());
    const double norm =
        (root_area.array() * rho * error.true_row_sums.array()).matrix().norm() / root_area.norm();
    if (norm == 0) continue;  // T = 0 in this channel, and so is A
    relative = std::max(relative, rho.maxCoeff() * (error.norm + rounding * approximate_norm) / norm);
  }
  certificate.spectral_radius_bound = radius * slack;
  certificate.operator_error = relative * slack;
  return certificate;
}

}  // namespace radiosity

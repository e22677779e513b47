#include "operators/capacitance.hpp"

#include <algorithm>
#include <utility>

namespace radiosity {

CapacitanceMatrices::CapacitanceMatrices(const LowRankFactors& factors)
    : rank_(factors.rank()), reflectances_(factors.albedo()) {
  constexpr Index columns_together = 64;
  std::vector<Eigen::MatrixXd> matrices(static_cast<std::size_t>(reflectances_.count()),
                                        Eigen::MatrixXd::Identity(rank_, rank_));
  for (Index first = 0; first < rank_; first += columns_together) {
    const Index columns = std::min(columns_together, rank_ - first);
    Field unit = Field::Zero(rank_, columns);
    unit.middleRows(first, columns).setIdentity();
    Field left(factors.albedo().rows(), columns);
    factors.multiply_left(unit, left);  // U
    for (Index distinct = 0; distinct < reflectances_.count(); ++distinct) {
      const auto reflectance = factors.albedo().col(reflectances_.representative(distinct));
      Field product(rank_, columns);
      factors.multiply_right_transposed(reflectance.asDiagonal() * left, product);
      matrices[static_cast<std::size_t>(distinct)].middleCols(first, columns) -= product;
    }
  }
  factored_.reserve(matrices.size());
  for (Eigen::MatrixXd& matrix : matrices) factored_.emplace_back(std::move(matrix));
}

double CapacitanceMatrices::reciprocal_condition() const {
  double smallest = 1;
  for (const LuFactors& factors : factored_) smallest = std::min(smallest, factors.reciprocal_condition());
  return smallest;
}

bool CapacitanceMatrices::singular() const {
  return !(reciprocal_condition() >= static_cast<double>(std::max<Index>(rank_, 1)) * 0x1p-53);
}

}  // namespace radiosity

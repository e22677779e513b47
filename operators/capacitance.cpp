#include "operators/capacitance.hpp"

#include <algorithm>
#include <utility>

namespace radiosity {
namespace {

double one_norm(const Eigen::MatrixXd& matrix) {
  return matrix.size() == 0 ? 0 : matrix.cwiseAbs().colwise().sum().maxCoeff();
}

double norm_of_difference_from_identity(const Eigen::MatrixXd& matrix) {
  return one_norm(Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols()) - matrix);
}

}  // namespace

CapacitanceMatrix::CapacitanceMatrix(Eigen::MatrixXd C)
    : CapacitanceMatrix(C, one_norm(C), norm_of_difference_from_identity(C)) {}

CapacitanceMatrix::CapacitanceMatrix(Eigen::MatrixXd C, double norm, double norm_of_product)
    : factors_(std::move(C)),
      reciprocal_condition_(
          factors_.size() == 0 ? 1 : factors_.reciprocal_condition() * norm / (1 + norm_of_product)) {}

CapacitanceMatrices::CapacitanceMatrices(const LowRankFactors& factors)
    : reflectances_(factors.albedo()), patches_(factors.albedo().rows()) {
  constexpr Index columns_together = 64;
  const Index rank = factors.rank();
  std::vector<Eigen::MatrixXd> matrices(static_cast<std::size_t>(reflectances_.count()),
                                        Eigen::MatrixXd::Identity(rank, rank));
  for (Index first = 0; first < rank; first += columns_together) {
    const Index columns = std::min(columns_together, rank - first);
    Field unit = Field::Zero(rank, columns);
    unit.middleRows(first, columns).setIdentity();
    Field left(patches_, columns);
    factors.multiply_left(unit, left);  // U
    for (Index distinct = 0; distinct < reflectances_.count(); ++distinct) {
      const auto reflectance = factors.albedo().col(reflectances_.representative(distinct));
      Field product(rank, columns);
      factors.multiply_right_transposed(reflectance.asDiagonal() * left, product);
      matrices[static_cast<std::size_t>(distinct)].middleCols(first, columns) -= product;
    }
  }
  matrices_.reserve(matrices.size());
  for (Eigen::MatrixXd& matrix : matrices) matrices_.emplace_back(std::move(matrix));
}

double CapacitanceMatrices::reciprocal_condition() const {
  double smallest = 1;
  for (const CapacitanceMatrix& matrix : matrices_)
    smallest = std::min(smallest, matrix.reciprocal_condition());
  return smallest;
}

bool CapacitanceMatrices::singular() const {
  return !(reciprocal_condition() >= static_cast<double>(std::max<Index>(patches_, 1)) * 0x1p-53);
}

}  // namespace radiosity

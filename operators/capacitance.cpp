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
  Field diagonals(patches_, reflectances_.count());
  for (Index distinct = 0; distinct < reflectances_.count(); ++distinct)
    diagonals.col(distinct) = factors.albedo().col(reflectances_.representative(distinct));
  matrices_.reserve(static_cast<std::size_t>(diagonals.cols()));
  for (const Eigen::MatrixXd& product : factors.multiply_between(diagonals))
    matrices_.emplace_back(Eigen::MatrixXd::Identity(product.rows(), product.cols()) - product);
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

#include "solvers/materialized_transport.hpp"

#include "foundation/error.hpp"

#include <algorithm>

namespace radiosity {

namespace {

constexpr Index block_columns = 64;

}  // namespace

void require_memory(const std::string& name, Index n, Index matrices, std::size_t limit) {
  const double bytes = 8.0 * static_cast<double>(n) * static_cast<double>(n) * static_cast<double>(matrices);
  if (bytes > static_cast<double>(limit))
    fail(
        "{}: needs the entries of T, {:.1f} GB for {} patches, where {:.1f} GB are allowed: use cg or gmres.",
        name, 1e-9 * bytes, n, 1e-9 * static_cast<double>(limit));
}

Eigen::MatrixXd kernel_matrix(const KernelOperator& transport) {
  const Index n = transport.size();
  Eigen::MatrixXd matrix(n, n);
  for (Index first = 0; first < n; first += block_columns) {
    const Index width = std::min(block_columns, n - first);
    Field units = Field::Zero(n, width);
    for (Index k = 0; k < width; ++k) units(first + k, k) = 1;
    transport.apply_kernel(units, matrix.middleCols(first, width));
  }
  return matrix;
}

std::vector<Eigen::MatrixXd> transport_matrices(const LinearOperator& transport) {
  const Index n = transport.size();
  const Index channels = transport.channels();
  std::vector<Eigen::MatrixXd> matrices(static_cast<std::size_t>(channels), Eigen::MatrixXd(n, n));
  for (Index first = 0; first < n; first += block_columns) {
    const Index width = std::min(block_columns, n - first);
    Field units = Field::Zero(n, width * channels);
    for (Index k = 0; k < units.cols(); ++k) units(first + k / channels, k) = 1;
    Field images(n, units.cols());
    transport.apply(units, images);
    for (Index k = 0; k < units.cols(); ++k)
      matrices[static_cast<std::size_t>(k % channels)].col(first + k / channels) = images.col(k);
  }
  return matrices;
}

TransportRows::TransportRows(const std::string& name, const LinearOperator& transport,
                             const Eigen::VectorXd& root_area, std::size_t limit)
    : kernel_(dynamic_cast<const KernelOperator*>(&transport)) {
  require_memory(name, transport.size(), kernel_ != nullptr ? 1 : transport.channels(), limit);
  if (kernel_ != nullptr) {
    columns_.push_back(kernel_matrix(*kernel_));
    return;
  }
  columns_ = transport_matrices(transport);
  for (Eigen::MatrixXd& matrix : columns_) {
    matrix = root_area.asDiagonal() * matrix * root_area.cwiseInverse().asDiagonal();
    matrix.transposeInPlace();
  }
}

double TransportRows::gather(Index i, Index channel, const Eigen::VectorXd& scaled_field) const {
  if (kernel_ != nullptr)
    return kernel_->reflectance()(i, channel) * columns_.front().col(i).dot(scaled_field);
  return columns_[static_cast<std::size_t>(channel)].col(i).dot(scaled_field);
}

}  // namespace radiosity

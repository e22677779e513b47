#include "compression/row_distances.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"

#include <cblas.h>

#include <algorithm>
#include <cstddef>

namespace radiosity {
namespace {

using Eigen::Index;

/// Centred codes are at most 128 in magnitude: sums of so many products are at most 2^24, which float32 holds
/// without rounding whatever the order of summation.
constexpr Index exact_columns = 1024;
constexpr float code_centre = 128;

/// G = C C' of at most exact_columns columns of codes; its lower triangle.
void gram_matrix(const Eigen::MatrixXf& centred, Eigen::MatrixXf& gram) {
  const auto n = static_cast<blasint>(centred.rows());
  cblas_ssyrk(CblasColMajor, CblasLower, CblasNoTrans, n, static_cast<blasint>(centred.cols()), 1,
              centred.data(), n, 0, gram.data(), n);
}

/// |x_i - x_j|^2 = G_ii + G_jj - 2 G_ij, added to the lower triangle.
void add_distances(const Eigen::MatrixXf& gram, Eigen::MatrixXd& squared) {
  const Index n = gram.rows();
  const Eigen::VectorXd norm = gram.diagonal().cast<double>();
  parallel_for(static_cast<std::size_t>(n), [&](std::size_t column) {
    const auto j = static_cast<Index>(column);
    squared.col(j).tail(n - j).array() +=
        norm.tail(n - j).array() + norm[j] - 2 * gram.col(j).tail(n - j).array().cast<double>();
  });
}

}  // namespace

Eigen::MatrixXd squared_row_distances(std::span<const CodeMatrix> channels) {
  const Index n = channels.empty() ? 0 : channels.front().rows();
  Eigen::MatrixXd squared = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXf gram(n, n);
  for (const CodeMatrix& codes : channels) {
    if (codes.rows() != n)
      fail<UsageError>("the channels of one matrix have {} and {} rows: as many are needed", n, codes.rows());
    for (Index first = 0; n > 0 && first < codes.cols(); first += exact_columns) {
      const Index count = std::min(exact_columns, codes.cols() - first);
      gram_matrix(codes.middleCols(first, count).cast<float>().array() - code_centre, gram);
      add_distances(gram, squared);
    }
  }
  squared.triangularView<Eigen::StrictlyUpper>() = squared.transpose();
  return squared;
}

}  // namespace radiosity

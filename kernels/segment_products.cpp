#include "kernels/segment_products.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"

#include <algorithm>

namespace radiosity {
namespace {

template <typename Scalar>
void add_weighted_rows(const Segments& V, const Eigen::VectorXd& diagonal, const TallMatrix<Scalar>& U,
                       Index segment, Eigen::Ref<Eigen::VectorXd> sums) {
  constexpr Index height = TallMatrix<Scalar>::panel_rows;
  const Index end = V.offsets()[static_cast<std::size_t>(segment) + 1];
  for (Index first = V.offsets()[static_cast<std::size_t>(segment)]; first < end;) {
    const Index panel = first / height;
    const Index last = std::min(end, (panel + 1) * height);
    double factors[height];
    for (Index e = first; e < last; ++e)
      factors[e - first] = (V.weights().empty() ? 1 : V.weights()[static_cast<std::size_t>(e)]) * diagonal[e];
    for (Index q = 0; q < U.columns(); ++q) {
      const Scalar* column = U.panel(panel) + q * height + first % height;
      double sum = 0;
      for (Index e = 0; e < last - first; ++e) sum += factors[e] * static_cast<double>(column[e]);
      sums[q] += U.scale() * sum;
    }
    first = last;
  }
}

}  // namespace

template <typename Scalar>
Eigen::MatrixXd transposed_segment_products(const Segments& V, const Eigen::VectorXd& diagonal,
                                            const TallMatrix<Scalar>& U) {
  if (V.rows() != U.rows() || V.count() != U.columns() || diagonal.size() != U.rows())
    fail<UsageError>("V of {} x {}, U of {} x {} and a diagonal of {} do not fit", V.rows(), V.count(),
                     U.rows(), U.columns(), diagonal.size());
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(U.columns(), U.columns());
  parallel_for(static_cast<std::size_t>(V.count()), [&](std::size_t segment) {
    const auto p = static_cast<Index>(segment);
    add_weighted_rows(V, diagonal, U, p, products.col(p));
  });
  return products;
}

template Eigen::MatrixXd transposed_segment_products(const Segments& V, const Eigen::VectorXd& diagonal,
                                                     const TallMatrix<double>& U);
template Eigen::MatrixXd transposed_segment_products(const Segments& V, const Eigen::VectorXd& diagonal,
                                                     const TallMatrix<float>& U);

}  // namespace radiosity

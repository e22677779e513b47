#include "experiments/low_rank_radiosity/shared_factor_frame.hpp"

#include "experiments/low_rank_radiosity/precomputed_woodbury.hpp"
#include "foundation/parallel.hpp"
#include "kernels/segment_sums.hpp"

#include <algorithm>
#include <utility>

namespace radiosity {

SharedFactorFrame::SharedFactorFrame(const Segments& V, const TallMatrix<float>& U,
                                     Eigen::MatrixXd reflectance)
    : V_(V), U_(U) {
  set_reflectance(std::move(reflectance));
}

void SharedFactorFrame::set_reflectance(Eigen::MatrixXd reflectance) {
  const Index rank = U_.columns();
  std::vector<Eigen::MatrixXd> inverses;
  inverses.reserve(static_cast<std::size_t>(reflectance.cols()));
  for (Index channel = 0; channel < reflectance.cols(); ++channel)
    inverses.push_back(transposed_capacitance(V_, U_, reflectance.col(channel))
                           .solve(Eigen::MatrixXd::Identity(rank, rank)));
  inverses_ = std::move(inverses);
  reflectance_ = std::move(reflectance);
  sums_.resize(rank, reflectance_.cols());
  coefficients_.resize(rank, reflectance_.cols());
}

void SharedFactorFrame::solve(const ConstFieldRef& E, FieldRef B) {
  segment_sums(V_, E, sums_, RowOrder::sorted);
  constexpr Index rows_of_a_task = 32;
  const Index tasks = (U_.columns() + rows_of_a_task - 1) / rows_of_a_task;
  parallel_for(static_cast<std::size_t>(tasks * sums_.cols()), [&](std::size_t task) {
    const Index channel = static_cast<Index>(task) / tasks;
    const Index first = static_cast<Index>(task) % tasks * rows_of_a_task;
    const Index rows = std::min(rows_of_a_task, U_.columns() - first);
    coefficients_.col(channel).segment(first, rows).noalias() =
        inverses_[static_cast<std::size_t>(channel)].middleCols(first, rows).transpose() * sums_.col(channel);
  });
  multiply(U_, coefficients_, B);
  constexpr Index elements_of_a_task = 8192;
  const Index parts = (E.rows() + elements_of_a_task - 1) / elements_of_a_task;
  parallel_for(static_cast<std::size_t>(parts), [&](std::size_t part) {
    const Index first = static_cast<Index>(part) * elements_of_a_task;
    const Index rows = std::min(elements_of_a_task, E.rows() - first);
    B.middleRows(first, rows).array() =
        E.middleRows(first, rows).array() +
        reflectance_.middleRows(first, rows).array() * B.middleRows(first, rows).array();
  });
}

std::size_t SharedFactorFrame::bytes() const {
  std::size_t total = U_.entry_bytes() + V_.offset_bytes() + V_.weight_bytes();
  for (const Eigen::MatrixXd& inverse : inverses_)
    total += static_cast<std::size_t>(inverse.size()) * sizeof(double);
  return total;
}

}  // namespace radiosity

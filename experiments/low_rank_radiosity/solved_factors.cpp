#include "experiments/low_rank_radiosity/solved_factors.hpp"

#include "foundation/parallel.hpp"
#include "foundation/random.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace radiosity {

SolvedFactors random_factors(const LowRankSize& size, std::uint64_t seed) {
  std::vector<std::int64_t> offsets(static_cast<std::size_t>(size.rank) + 1);
  for (Index p = 0; p <= size.rank; ++p) offsets[static_cast<std::size_t>(p)] = size.rows * p / size.rank;
  TallMatrix<float> Y(size.rows, size.rank);
  const double largest = 2.0 / static_cast<double>(size.rows);
  parallel_for(static_cast<std::size_t>(Y.panels()), [&](std::size_t index) {
    const auto b = static_cast<Index>(index);
    RandomStream random(seed, index);
    Eigen::MatrixXd entries(std::min(Y.panel_rows, size.rows - b * Y.panel_rows), size.rank);
    for (double& entry : entries.reshaped()) entry = -random.uniform(0, largest);
    Y.fill_panel(b, entries);
  });
  return {Segments(std::move(offsets)), std::move(Y)};
}

}  // namespace radiosity

#pragma once

#include "experiments/low_rank_radiosity/low_rank_tables.hpp"
#include "kernels/segments.hpp"
#include "kernels/tall_matrix.hpp"

#include <map>

namespace radiosity {

/// The cube with its lights, solved with the dense F of its n patches in double precision.
class DenseSolutions {
 public:
  /// Lights and seed are those of the options, which must outlive this.
  explicit DenseSolutions(const LowRankTablesOptions& options) : options_(options) {}

  /// How far B = E - Y (V' E) is from the dense B; rows of V and Y are the cube's, sorted by patch. Empty
  /// where there are more rows than largest_dense_error. Assembles and solves at the first call for each n.
  std::optional<DenseErrors> compare(const Segments& V, const TallMatrix<float>& Y, Monitor& monitor);

 private:
  struct Solution {
    PatchMesh mesh;
    Eigen::MatrixXd E;
    Eigen::MatrixXd B;
  };

  const Solution& solution(Index n, Monitor& monitor);

  const LowRankTablesOptions& options_;
  std::map<Index, Solution> solutions_;
};

}  // namespace radiosity

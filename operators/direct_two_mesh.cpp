#include "operators/direct_two_mesh.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace radiosity {
namespace {

/// The order in which U keeps its rows.
std::vector<Index> row_order(const Segments& V) {
  if (!V.order().empty()) return {V.order().begin(), V.order().end()};
  std::vector<Index> order(static_cast<std::size_t>(V.rows()));
  std::iota(order.begin(), order.end(), Index{0});
  return order;
}

/// Rows first, first + 1, ... of U from those of F_ep. `first` is the beginning of a panel.
void fill_rows(TallMatrix<float>& U, Index first, const Eigen::MatrixXd& factors,
               const Eigen::VectorXd& inverse_divisors) {
  constexpr Index panel_rows = TallMatrix<float>::panel_rows;
  const Index panels = (factors.rows() + panel_rows - 1) / panel_rows;
  parallel_for(static_cast<std::size_t>(panels), [&](std::size_t panel) {
    const Index begin = static_cast<Index>(panel) * panel_rows;
    const Index rows = std::min(panel_rows, factors.rows() - begin);
    U.fill_panel(first / panel_rows + static_cast<Index>(panel),
                 factors.middleRows(begin, rows) * inverse_divisors.asDiagonal());
  });
}

}  // namespace

DirectTwoMeshFactors compute_two_mesh_factors(const PatchMesh& elements, const CoarseMesh& coarse,
                                              const ElementFactorOptions& options, Monitor& monitor) {
  const ElementPartition partition(coarse.patch_of_element, elements.area);
  const Eigen::VectorXd inverse_divisors = partition.divisors().cwiseInverse();
  DirectTwoMeshFactors result{partition.right_factor(),
                              TallMatrix<float>(elements.patch_count(), partition.patches())};
  result.rays = compute_element_factors(
      elements, row_order(result.V), coarse.patches, options,
      [&](Index first, const Eigen::MatrixXd& factors) {
        fill_rows(result.U, first, factors, inverse_divisors);
      },
      monitor);
  return result;
}

std::uint64_t update_two_mesh_factors(DirectTwoMeshFactors& factors, const PatchMesh& elements,
                                      const CoarseMesh& coarse, const ElementFactorOptions& options,
                                      Monitor& monitor) {
  const ElementPartition partition(coarse.patch_of_element, elements.area);
  if (elements.patch_count() != factors.U.rows() || partition.patches() != factors.U.columns())
    fail<UsageError>("factors of {} x {} cannot become those of {} elements in {} patches", factors.U.rows(),
                     factors.U.columns(), elements.patch_count(), partition.patches());
  const Eigen::VectorXd inverse_divisors = partition.divisors().cwiseInverse();
  const std::vector<Index> order = row_order(factors.V);
  return compute_element_factors(
      elements, order, coarse.patches, options,
      [&](Index first, const Eigen::MatrixXd& rows) {
        parallel_for(static_cast<std::size_t>(rows.rows()), [&](std::size_t row) {
          const Index sorted = first + static_cast<Index>(row);
          const Index e = order[static_cast<std::size_t>(sorted)];
          for (Index p = 0; p < rows.cols(); ++p)
            if (!options.wanted || options.wanted(e, p))
              factors.U.set(sorted, p, rows(static_cast<Index>(row), p) * inverse_divisors[p]);
        });
      },
      monitor);
}

DirectTwoMesh make_direct_two_mesh(std::shared_ptr<const PatchMesh> elements, const PartitionChoice& choice,
                                   const ElementFactorOptions& options, const std::string& spec,
                                   Monitor& monitor) {
  const std::optional<CoarseMesh> coarse = make_coarse_mesh(*elements, choice);
  if (!coarse)
    fail<UsageError>(
        "'{}' has no coarse mesh of at most {} patches, for its faces are more: ask for a larger k",
        elements->scene->name, choice.patches);
  DirectTwoMeshFactors factors = compute_two_mesh_factors(*elements, *coarse, options, monitor);
  FormFactors form_factors;
  form_factors.mesh = std::move(elements);
  return {std::make_unique<SparseVOperator<float>>(form_factors, std::move(factors.V), std::move(factors.U),
                                                   spec, std::string()),
          factors.rays};
}

}  // namespace radiosity

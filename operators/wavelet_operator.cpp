#include "operators/wavelet_operator.hpp"

#include "factorizations/haar_wavelets.hpp"
#include "factorizations/halving_order.hpp"
#include "operators/low_rank_choice.hpp"
#include "operators/patch_planes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace radiosity {
namespace {

/// The patches of each plane, so that halves, and halves of halves, are compact.
std::vector<std::vector<Index>> halved_planes(const PatchMesh& mesh) {
  std::vector<std::vector<Index>> sequences;
  for (const PlacedSet& plane : patch_planes(mesh)) {
    Eigen::MatrixXd coordinates = plane.places;
    if (std::isfinite(plane.aspect)) coordinates.row(0) *= plane.aspect;
    const std::vector<Index> order = halving_order(coordinates);
    std::vector<Index>& sequence = sequences.emplace_back(order.size());
    std::transform(order.begin(), order.end(), sequence.begin(),
                   [&](Index place) { return plane.items[static_cast<std::size_t>(place)]; });
  }
  return sequences;
}

}  // namespace

std::unique_ptr<LinearOperator> make_wavelet_operator(Spec& spec, const FormFactors& form_factors) {
  const LowRankChoice choice = LowRankChoice::take(spec);
  const std::int64_t seed = spec.integer("seed", 1, 0, std::numeric_limits<std::int64_t>::max());
  spec.finish();
  choice.require_kernel(form_factors);
  const PatchMesh& mesh = *form_factors.mesh;
  LowRankPair pair = project_on_functions(form_factor_products(form_factors, choice.norm),
                                          haar_wavelets(halved_planes(mesh), choice.root_weight(mesh)),
                                          choice.rank, static_cast<std::uint64_t>(seed));
  return make_low_rank_operator(choice, form_factors, std::move(pair),
                                fmt::format("wavelet:{},seed={}", choice.text(), seed));
}

}  // namespace radiosity

#include "operators/wavelet_operator.hpp"

#include "factorizations/haar_wavelets.hpp"
#include "factorizations/halving_order.hpp"
#include "operators/low_rank_choice.hpp"
#include "operators/patch_planes.hpp"
#include "operators/patch_coordinates.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <cstdlib>
#include <numeric>

namespace radiosity {
namespace {
std::vector<std::vector<Index>> sequences(const PatchMesh& mesh) {
  const char* e = std::getenv("RAD_ORDER");
  const int mode = e ? std::atoi(e) : 1;
  std::vector<std::vector<Index>> sets;
  if (mode == 0) {
    sets.emplace_back(mesh.patch_count());
    std::iota(sets[0].begin(), sets[0].end(), 0);
  } else if (mode == 2) {
    sets.push_back(halving_order(patch_coordinates(mesh)));
  } else
    for (const PlacedSet& set : patch_planes(mesh)) {
      Eigen::MatrixXd c = set.places;
      if (std::isfinite(set.aspect)) c.row(0) *= set.aspect;
      std::vector<Index> o = halving_order(c);
      for (Index& i : o) i = set.items[i];
      sets.push_back(o);
    }
  return sets;
}
}  // namespace

std::unique_ptr<LinearOperator> make_wavelet_operator(Spec& spec, const FormFactors& form_factors) {
  const LowRankChoice choice = LowRankChoice::take(spec);
  const std::int64_t seed = spec.integer("seed", 1, 0, std::numeric_limits<std::int64_t>::max());
  spec.finish();
  choice.require_kernel(form_factors);
  const PatchMesh& mesh = *form_factors.mesh;
  const Eigen::VectorXd root_weight =
      choice.in_area_norm() ? Eigen::VectorXd(mesh.area.cwiseSqrt()) : Eigen::VectorXd::Ones(mesh.patch_count());
  return make_low_rank_operator(
      choice, form_factors,
      project_on_functions(form_factor_products(form_factors, choice.norm),
                           haar_wavelets(sequences(mesh), root_weight), choice.rank,
                           static_cast<std::uint64_t>(seed)),
      fmt::format("wavelet:{},seed={}", choice.text(), seed));
}

}  // namespace radiosity

#include "operators/dct_operator.hpp"

#include "factorizations/cosines.hpp"
#include "factorizations/halving_order.hpp"
#include "operators/low_rank_choice.hpp"
#include "operators/patch_planes.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <cstdlib>
#include <numeric>

namespace radiosity {
namespace {
std::vector<PlacedSet> cosine_sets(const PatchMesh& mesh) {
  const char* e = std::getenv("RAD_ORDER");
  const int mode = e ? std::atoi(e) : 1;
  if (mode == 0) {
    PatchMesh empty;
    empty.patches = mesh.patches;
    return patch_planes(empty);
  }
  std::vector<PlacedSet> sets = patch_planes(mesh);
  if (mode == 2)
    for (PlacedSet& set : sets) {
      Eigen::MatrixXd c = set.places;
      if (std::isfinite(set.aspect)) c.row(0) *= set.aspect;
      std::vector<Index> o = halving_order(c);
      for (Index i = 0; i < (Index)o.size(); ++i) { set.places(0, o[i]) = ((double)i + 0.5) / (double)o.size(); set.places(1, o[i]) = .5; }
      set.aspect = INFINITY;
    }
  return sets;
}
}  // namespace

std::unique_ptr<LinearOperator> make_dct_operator(Spec& spec, const FormFactors& form_factors) {
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
                           cosines(cosine_sets(mesh), root_weight), choice.rank,
                           static_cast<std::uint64_t>(seed)),
      fmt::format("dct:{},seed={}", choice.text(), seed));
}

}  // namespace radiosity

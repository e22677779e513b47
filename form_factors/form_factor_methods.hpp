#pragma once

#include "form_factors/form_factors.hpp"
#include "form_factors/pair_exchange.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <memory>

namespace radiosity {

/// A kernel and the rays that it took.
struct AssembledKernel {
  std::shared_ptr<SymmetricTiles<double>> kernel;
  std::uint64_t rays = 0;
  Eigen::MatrixXd
      group_variance;  ///< groups x groups: estimated variance of each F_gh; empty where nothing is sampled
};

/// Each unordered pair once, see PairExchange.
AssembledKernel assemble_accurate(const PatchMesh& mesh, const PairExchange& exchange, Monitor& monitor);

/// Document 003, section 3.3.1: point-to-point form factors between incircle centres with a single ray for
/// visibility; F_ji by reciprocity. A quad uses its centroid. Errors of 50 % near shared edges are the
/// method's own.
AssembledKernel assemble_one_ray(const PatchMesh& mesh, const PatchGeometry& geometry,
                                 const Occluders& occluders, Monitor& monitor);

/// F by cosine-distributed rays from every patch, each hit on a front counting 1 / rays, traced against the
/// patches themselves. Rows of an enclosure sum to 1 but for rounding and leaks; not reciprocal.
struct GatheredFactors {
  std::shared_ptr<RowMajorMatrix<double>> factors;
  std::uint64_t rays = 0;
};
GatheredFactors gather_form_factors(const PatchMesh& mesh, const PatchGeometry& geometry,
                                    std::uint32_t rays_per_patch, std::uint64_t seed, Monitor& monitor);

}  // namespace radiosity

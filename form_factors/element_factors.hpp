#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/monitor.hpp"
#include "scene/patch_mesh.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <span>

namespace radiosity {

/// Whether F_ep of element e and patch p is asked for. Called from several threads at once.
using ElementFactorChoice = std::function<bool(Index e, Index p)>;

struct ElementFactorOptions {
  double tolerance = 1e-3;  ///< estimated standard error of each F_ep
  std::uint64_t seed = 1;
  ElementFactorChoice wanted = {};  ///< what is not wanted is given as 0 and costs little; empty: all
};

/// Takes F_ep of the elements order[first], order[first + 1], ...: c x k. Called with rising `first`, never
/// twice at once.
using ElementFactorSink = std::function<void(Index first, const Eigen::MatrixXd& factors)>;

/// F_ep, the fraction of what leaves element e and arrives at patch p, for the n elements and the k patches
/// of two meshes of one scene (document 004, section 3.2), by the accurate method and without an n x n
/// matrix: some thousand elements at a time, so that memory stays at that of the meshes. `order`: n, the
/// order in which elements are wanted. Depends on the seed, not on the number of threads. Returns the number
/// of rays.
std::uint64_t compute_element_factors(const PatchMesh& elements, std::span<const Index> order,
                                      const PatchMesh& patches, const ElementFactorOptions& options,
                                      const ElementFactorSink& sink, Monitor& monitor);

}  // namespace radiosity

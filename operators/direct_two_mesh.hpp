#pragma once

#include "form_factors/element_factors.hpp"
#include "foundation/monitor.hpp"
#include "operators/element_partition.hpp"
#include "operators/sparse_v_operator.hpp"

#include <cstdint>
#include <memory>
#include <string>

namespace radiosity {

/// U and V of F ~ U V' (document 004, Equation 6), rows sorted by patch.
struct DirectTwoMeshFactors {
  Segments V;
  TallMatrix<float> U;
  std::uint64_t rays = 0;
};

/// U from form factors between elements and patches, n k of them (document 004, section 3.2: F_ep), and no n
/// x n matrix: memory stays at that of U and the meshes.
DirectTwoMeshFactors compute_two_mesh_factors(const PatchMesh& elements, const CoarseMesh& coarse,
                                              const ElementFactorOptions& options, Monitor& monitor);

/// Makes U that of other meshes with as many elements and patches, each element in its old patch and as large
/// as before, where only the pairs that options.wanted names are taken to differ: after something has moved
/// (form_factors/moved_pairs.hpp). Returns the number of rays. Throws UsageError where the meshes do not fit.
std::uint64_t update_two_mesh_factors(DirectTwoMeshFactors& factors, const PatchMesh& elements,
                                      const CoarseMesh& coarse, const ElementFactorOptions& options,
                                      Monitor& monitor);

struct DirectTwoMesh {
  std::unique_ptr<SparseVOperator<float>> transport;
  std::uint64_t rays = 0;
};

/// The sparse-V operator of a coarse mesh with these factors. F_ep here is exact for the polygon of a patch,
/// which for meshes that do not fit each other differs a little from the sum over the patch's elements.
/// `elements` supplies areas and reflectances too. Throws UsageError where the scene has no coarse mesh of at
/// most k patches.
DirectTwoMesh make_direct_two_mesh(std::shared_ptr<const PatchMesh> elements, const PartitionChoice& choice,
                                   const ElementFactorOptions& options, const std::string& spec,
                                   Monitor& monitor);

}  // namespace radiosity

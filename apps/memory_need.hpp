#pragma once

#include "form_factors/form_factors.hpp"
#include "scene/patch_mesh.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace radiosity {

/// At most how many bytes the form factors of n patches take: the upper half of K in double precision, or all
/// of F for gather.
double form_factor_bytes(Index patch_count, FormFactorMethod method);

/// How many unordered pairs of patches can see each other as far as their planes go: each has a part of the
/// other in front. Takes a step for each patch and face.
std::uint64_t facing_pairs(const PatchMesh& mesh);

/// At most how many bytes an operator takes to be applied: what blocks light only makes it less.
struct MemoryNeed {
  std::string operator_spec;
  double bytes = 0;
};
std::vector<MemoryNeed> memory_needs(const PatchMesh& mesh);

}  // namespace radiosity

#pragma once

#include "compression/colour_compression.hpp"
#include "foundation/spec.hpp"
#include "scene/patch_mesh.hpp"

#include <cstdint>
#include <string>

namespace radiosity {

/// The order in which a compressed matrix keeps rows, columns and patches alike (document 000, Section 3.5).
struct TexelOrderChoice {
  std::string reorder = "both";  ///< none, morton, rows, both or 2opt
  std::string start = "face";    ///< face or random: the order that it starts from
  std::int64_t seed = 1;         ///< of the random one

  /// Takes reorder, start and, if that is random, seed.
  static TexelOrderChoice take(Spec& spec);
  std::string text() const;
};

/// none: the start itself. morton: patches of a plane along a curve that halves it in turns, no search at
/// all. rows: greedily by the distances of coded rows. both: then greedily by those of columns. 2opt: rows,
/// then a shorter path by 2-opt.
TexelOrder make_texel_order(const TexelOrderChoice& choice, const PatchMesh& mesh);

}  // namespace radiosity

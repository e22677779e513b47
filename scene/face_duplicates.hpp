#pragma once

#include "scene/scene.hpp"

namespace radiosity {

/// Faces that repeat an earlier one: the same corners (within 1e-9 of the diagonal) in the same cyclic order.
struct DuplicateFaces {
  std::size_t count = 0;
  std::size_t first = 0;  ///< the first face that repeats another
};

DuplicateFaces find_duplicates(const Scene& scene);

}  // namespace radiosity

#pragma once

#include "gpu/shader_sources.hpp"

#include <vector>

namespace radiosity {

/// Each shader with the largest constants that it is compiled with, in every precision.
inline std::vector<ShaderVariant> shader_variants() {
  std::vector<ShaderVariant> variants;
  for (const int half : {0, 1}) {
    variants.push_back(
        {"dense_group.comp", {{"COLUMNS", 4}, {"HALF", half}, {"ROWS", 4}, {"INVOCATIONS", 128}}});
    variants.push_back({"dense_invocation.comp", {{"COLUMNS", 4}, {"HALF", half}, {"ROWS", 64}}});
  }
  return variants;
}

}  // namespace radiosity

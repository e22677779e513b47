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
    variants.push_back({"dense_texels.comp", {{"COLUMNS", 4}, {"EIGHT", half}}});
  }
  for (const int lanes : {1, 32})
    for (const int present : {0, 1}) {
      for (const int together : {1, 4})
        variants.push_back({"csr_rows.comp",
                            {{"COLUMNS", 4},
                             {"INVOCATIONS", 128},
                             {"TOGETHER", together},
                             {"LANES", lanes},
                             {"DOUBLE", 1 - present},
                             {"NARROW", present},
                             {"ADDS", present}}});
      variants.push_back(
          {"texture_sampled.comp",
           {{"CHANNELS", 3}, {"LOGARITHMIC", present}, {"INVOCATIONS", 64}, {"LANES", lanes}}});
    }
  for (const int present : {0, 1}) {
    for (const int together : {1, 4})
      variants.push_back({"csr_texels.comp",
                          {{"COLUMNS", 4}, {"INVOCATIONS", 64}, {"TOGETHER", together}, {"ADDS", present}}});
    variants.push_back(
        {"texture_product.comp", {{"CHANNELS", 3}, {"LOGARITHMIC", present}, {"INVOCATIONS", 64}}});
    variants.push_back({"texture_texels.comp", {{"CHANNELS", 3}, {"LOGARITHMIC", present}, {"ROWS", 4}}});
  }
  for (const int code : {0, 1, 2, 3, 4, 5})
    for (const int present : {0, 1})
      variants.push_back({"tile_product.comp",
                          {{"COLUMNS", 4},
                           {"CODE", code},
                           {"BITS", present == 1 ? 2 : 8},
                           {"BLOCK", present == 1 ? 16 : 64},
                           {"LOGARITHMIC", present},
                           {"SYMMETRIC", present},
                           {"INVOCATIONS", 64},
                           {"LANES", present == 1 ? 64 : 1}}});
  for (const int lanes : {1, 32}) variants.push_back({"patch_emission.comp", {{"LANES", lanes}}});
  for (const int layers : {1, 6})
    for (const char* stage : {"shadow.geom", "injection.geom"})
      variants.push_back({stage, {{"LAYERS", layers}}});
  for (const char* plain : {"vertex_light.comp", "shadow.vert", "shadow.frag", "frame.vert", "frame.frag",
                            "injection.frag", "injection_sums.comp", "injection_emission.comp"})
    variants.push_back({plain, {}});
  for (const int lanes : {1, 16})
    variants.push_back({"dense_double.comp", {{"COLUMNS", 4}, {"INVOCATIONS", 64}, {"LANES", lanes}}});
  variants.push_back({"tall_transposed_texels.comp", {{"COLUMNS", 4}, {"SHARE", 4}}});
  variants.push_back({"tall_product_texels.comp", {{"COLUMNS", 4}, {"ORDERED", 1}}});
  for (const int present : {0, 1}) {
    variants.push_back({"tall_product.comp", {{"COLUMNS", 4}, {"ORDERED", present}, {"DOUBLE", present}}});
    variants.push_back({"tall_transposed.comp", {{"COLUMNS", 4}, {"DOUBLE", present}}});
    variants.push_back({"transport_step.comp", {{"FIRST", present}}});
    variants.push_back({"sum_chunks.comp", {{"SCALED", present}, {"DOUBLE", present}}});
    variants.push_back({"segment_sums.comp",
                        {{"COLUMNS", 4},
                         {"ORDERED", present},
                         {"WEIGHTED", present},
                         {"LANES", present == 1 ? 64 : 1},
                         {"DOUBLE", present}}});
  }
  variants.push_back({"frame_sum.comp", {}});
  variants.push_back({"neumann_step.comp", {{"SUMS", 1}, {"SHARED", 1}}});
  variants.push_back({"cg_image.comp", {{"SUMS", 1}, {"SHARED", 0}}});
  variants.push_back({"cg_update.comp", {{"SUMS", 2}, {"SHARED", 1}}});
  variants.push_back({"cg_direction.comp", {{"SUMS", 0}, {"SHARED", 1}}});
  for (const int stage : {0, 1, 2})
    variants.push_back({"column_scalars.comp", {{"SUMS", stage == 2 ? 2 : 1}, {"STAGE", stage}}});
  return variants;
}

}  // namespace radiosity

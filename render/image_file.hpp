#pragma once

#include "render/picture.hpp"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace radiosity {

/// Writes radiance as it is: OpenEXR, linear float32 RGB. Appears whole or not at all; throws Error if it
/// cannot.
void write_exr(const std::filesystem::path& file, const Picture& picture);

/// Writes tone-mapped bytes (tone_mapping.hpp), 3 x width x height: PNG, 8 bit sRGB. Same promises.
void write_png(const std::filesystem::path& file, int width, int height,
               const std::vector<std::uint8_t>& bytes);

}  // namespace radiosity

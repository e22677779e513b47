#pragma once

#include "form_factors/form_factors.hpp"

#include <filesystem>

namespace radiosity {

/// Stores an assembled kernel (or gathered F) with its quality, float64, with the fingerprint of the patches
/// and faces that it belongs to. The file appears whole or not at all. Byte order: little endian.
void save_kernel(const std::filesystem::path& file, const FormFactors& form_factors);

/// Reads it back for a mesh of the same patches. Throws Error if the file is not a kernel, is truncated or
/// damaged, or belongs to other patches.
FormFactors load_kernel(const std::filesystem::path& file, std::shared_ptr<const PatchMesh> mesh);

}  // namespace radiosity

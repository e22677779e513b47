#pragma once

#include <filesystem>

namespace radiosity {

/// Throws Error if a file cannot be written there: asked before long work begins, so that it is not done in
/// vain. An empty path means that no file is wanted.
void require_writable(const std::filesystem::path& file);

/// The same, and throws UsageError if the name does not end in `extension` (with its dot).
void require_writable(const std::filesystem::path& file, const char* extension);

}  // namespace radiosity

#pragma once

namespace radiosity {

/// Gives pages that were freed back to the system, after many small blocks of a step that is over: the C
/// library keeps them otherwise, and they count as this process's beside what comes next. Does nothing where
/// the C library cannot (not glibc).
void release_freed_memory();

}  // namespace radiosity

#pragma once

#include <string>

namespace radiosity {

/// Bytes of physical memory that this machine has.
double machine_memory();

/// Bytes that can be had without swapping; all there are where the system does not say.
double available_memory();

/// Throws Error where `bytes` cannot be had without swapping, before anything is allocated: a process that
/// takes more is stopped without a word. `subject` begins the sentence ("bounces:k=3 of 70000 patches"),
/// `advice` ends it.
void require_available_memory(const std::string& subject, double bytes,
                              const std::string& advice = "take fewer patches");

/// Bytes for a person: "48.1 MB" (powers of ten).
std::string byte_text(double bytes);

/// Gives pages that were freed back to the system, after many small blocks of a step that is over: the C
/// library keeps them otherwise, and they count as this process's beside what comes next. Does nothing where
/// the C library cannot (not glibc).
void release_freed_memory();

}  // namespace radiosity

#pragma once

#include <cstddef>
#include <memory>

namespace radiosity {

/// Zeroed memory aligned to 64 bytes; blocks of some size are aligned to 2 MiB and ask for huge pages, which
/// long streams of reads need to reach the memory's bandwidth. No bytes: null. Throws std::bad_alloc.
void* allocate_zeroed(std::size_t bytes);
/// The same without zeroing, for short-lived buffers.
void* allocate_aligned(std::size_t bytes);
void release_aligned(void* memory);

struct AlignedRelease {
  void operator()(void* memory) const { release_aligned(memory); }
};

/// A short-lived aligned buffer of numbers, not initialised.
template <typename Number>
class AlignedBuffer {
 public:
  explicit AlignedBuffer(std::size_t count)
      : numbers_(static_cast<Number*>(allocate_aligned(count * sizeof(Number)))) {}
  Number* data() const { return numbers_.get(); }

 private:
  std::unique_ptr<Number, AlignedRelease> numbers_;
};

}  // namespace radiosity

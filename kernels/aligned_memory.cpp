#include "kernels/aligned_memory.hpp"

#include <cstdlib>
#include <cstring>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace radiosity {
namespace {

constexpr std::size_t cache_line = 64;
constexpr std::size_t huge_page = std::size_t{1} << 21;

}  // namespace

void* allocate_aligned(std::size_t bytes) {
  if (bytes == 0) return nullptr;
  const std::size_t alignment = bytes >= 2 * huge_page ? huge_page : cache_line;
  const std::size_t size = (bytes + alignment - 1) / alignment * alignment;
  if (size < bytes) throw std::bad_alloc();
  void* memory = std::aligned_alloc(alignment, size);
  if (memory == nullptr) throw std::bad_alloc();
#if defined(__linux__)
  if (alignment == huge_page) madvise(memory, size, MADV_HUGEPAGE);  // a wish: refusal costs speed only
#endif
  return memory;
}

void* allocate_zeroed(std::size_t bytes) {
  void* memory = allocate_aligned(bytes);
  if (memory != nullptr) std::memset(memory, 0, bytes);
  return memory;
}

void release_aligned(void* memory) {
  std::free(memory);
}

}  // namespace radiosity

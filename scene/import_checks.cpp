#include "scene/import_checks.hpp"

#include "foundation/error.hpp"

#include <cstdint>
#include <cstring>

namespace radiosity {
namespace {

std::uint32_t word_at(std::string_view content, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, content.data() + offset, sizeof word);
  return word;
}

}  // namespace

void check_glb(const std::string& file, std::string_view content) {
  if (content.size() < 20 || content.substr(0, 4) != "glTF") fail("'{}' is not a GLB file", file);
  if (word_at(content, 8) != content.size())
    fail("'{}' is truncated: {} bytes are announced, {} are there", file, word_at(content, 8),
         content.size());
  for (std::size_t offset = 12; offset < content.size();) {
    const std::uint64_t length = content.size() - offset >= 8 ? word_at(content, offset) : UINT32_MAX;
    if (offset + 8 + length > content.size())
      fail("'{}' is damaged: a chunk at byte {} reaches beyond its end", file, offset);
    offset += 8 + length;
  }
}

}  // namespace radiosity

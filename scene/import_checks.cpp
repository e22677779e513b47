#include "scene/import_checks.hpp"

#include "foundation/error.hpp"
#include "scene/text_lines.hpp"

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

void check_stl(const std::string& file, std::string_view content) {
  const bool has_count = content.size() >= 84;
  const std::uint64_t needed = has_count ? 84 + 50 * std::uint64_t{word_at(content, 80)} : 0;
  if (has_count && needed == content.size()) return;  // binary, whatever its first word
  if (content.substr(0, 5) != "solid")
    fail("'{}' is truncated: {} bytes are announced, {} are there", file, has_count ? needed : 84,
         content.size());
  TextLines lines(file, content);
  int corners = 0;
  bool ended = false;
  while (lines.next()) {
    const auto& words = lines.words();
    ended = words[0] == "endsolid";
    if (words[0] == "endloop") {
      if (corners != 3) lines.fail_here(fmt::format("a facet has {} corners instead of three", corners));
      corners = 0;
    }
    if (words[0] != "vertex") continue;
    ++corners;
    if (words.size() != 4) lines.fail_here("a vertex needs three numbers; the line may be truncated");
    for (std::size_t k = 1; k < 4; ++k) lines.finite_number(k);
  }
  if (!ended) lines.fail_here("the file ends before 'endsolid': it may be truncated");
}

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

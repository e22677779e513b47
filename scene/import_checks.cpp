#include "scene/import_checks.hpp"

#include "foundation/error.hpp"
#include "scene/text_lines.hpp"

#include <charconv>
#include <cstdint>
#include <cstring>

namespace radiosity {
namespace {

std::uint32_t word_at(std::string_view content, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, content.data() + offset, sizeof word);
  return word;
}

std::uint64_t scalar_bytes(std::string_view type) {
  if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
  if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
  if (type == "int" || type == "uint" || type == "int32" || type == "uint32" || type == "float" ||
      type == "float32")
    return 4;
  return type == "double" || type == "float64" ? 8 : 0;
}

/// The header of a PLY file, element by element.
class PlyHeader {
 public:
  PlyHeader(const std::string& file, std::string_view header, std::uint64_t body)
      : lines_(file, header), body_(body) {}

  void check() {
    if (!lines_.next() || lines_.words().front() != "ply") lines_.fail_here("not a PLY file");
    while (lines_.next()) statement();
    if (format_.empty()) lines_.fail_here("the PLY header names no format");
    if (vertex_count_ == 0) lines_.fail_here("the PLY header announces no vertices");
    if (face_count_ == 0) lines_.fail_here("the PLY header announces no faces: nothing to light");
    close_element();
    if (needed_ > body_)
      lines_.fail_here(
          fmt::format("truncated: at least {} bytes are announced, {} are there", needed_, body_));
  }

 private:
  void statement() {
    const auto& words = lines_.words();
    if (words[0] == "format" && words.size() == 3) {
      format_ = words[1];
      if (format_ != "ascii" && format_ != "binary_little_endian" && format_ != "binary_big_endian")
        lines_.fail_here(fmt::format("unknown PLY format '{}'", format_));
    } else if (words[0] == "element" && words.size() == 3) {
      element();
    } else if (words[0] == "property") {
      property();
    } else if (words[0] != "comment" && words[0] != "obj_info") {
      lines_.fail_here(fmt::format("'{}' does not belong into a PLY header", words[0]));
    }
  }

  void element() {
    close_element();
    const std::string_view digits = lines_.words()[2];
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), count_);
    if (error != std::errc{} || stop != digits.data() + digits.size() || count_ > (std::uint64_t{1} << 31U))
      lines_.fail_here(fmt::format("'{}' is not a possible number of elements", digits));
    if (lines_.words()[1] == "vertex") vertex_count_ = count_;
    if (lines_.words()[1] == "face") face_count_ = count_;
    element_bytes_ = 0;
  }

  /// The least that a property takes: a text number and a blank, or its type (of a list, the count alone).
  void property() {
    const auto& words = lines_.words();
    const bool list = words.size() == 5 && words[1] == "list";
    if ((!list && words.size() != 3) || scalar_bytes(list ? words[2] : words[1]) == 0 ||
        (list && scalar_bytes(words[3]) == 0))
      lines_.fail_here("a PLY property is 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
    element_bytes_ += format_ == "ascii" ? 2 : scalar_bytes(list ? words[2] : words[1]);
  }

  void close_element() {
    const std::uint64_t last_newline = format_ == "ascii" && element_bytes_ > 0 && count_ > 0 ? 1 : 0;
    needed_ += count_ * element_bytes_ - last_newline;
    count_ = element_bytes_ = 0;
  }

  TextLines lines_;
  std::uint64_t body_;
  std::string format_;
  std::uint64_t count_ = 0, element_bytes_ = 0, needed_ = 0, vertex_count_ = 0, face_count_ = 0;
};

}  // namespace

void check_ply(const std::string& file, std::string_view content) {
  const std::size_t end = content.find("end_header");
  if (end == std::string_view::npos) fail("'{}' has no complete PLY header", file);
  PlyHeader(file, content.substr(0, end), content.size() - end).check();
}

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

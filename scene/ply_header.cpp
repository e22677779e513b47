#include "scene/ply_header.hpp"

#include "foundation/error.hpp"
#include "scene/text_lines.hpp"

#include <algorithm>
#include <charconv>
#include <map>

namespace radiosity {
namespace {

PlyScalar scalar_named(const TextLines& lines, std::string_view name) {
  static const std::map<std::string_view, PlyScalar> scalars = {
      {"char", PlyScalar::int8},      {"int8", PlyScalar::int8},       {"uchar", PlyScalar::uint8},
      {"uint8", PlyScalar::uint8},    {"short", PlyScalar::int16},     {"int16", PlyScalar::int16},
      {"ushort", PlyScalar::uint16},  {"uint16", PlyScalar::uint16},   {"int", PlyScalar::int32},
      {"int32", PlyScalar::int32},    {"uint", PlyScalar::uint32},     {"uint32", PlyScalar::uint32},
      {"float", PlyScalar::float32},  {"float32", PlyScalar::float32}, {"double", PlyScalar::float64},
      {"float64", PlyScalar::float64}};
  const auto found = scalars.find(name);
  if (found == scalars.end()) lines.fail_here(fmt::format("'{}' is no PLY type", name));
  return found->second;
}

PlyFormat format_of(const TextLines& lines) {
  const auto& words = lines.words();
  if (words.size() == 3 && words[1] == "ascii") return PlyFormat::ascii;
  if (words.size() == 3 && words[1] == "binary_little_endian") return PlyFormat::little_endian;
  if (words.size() == 3 && words[1] == "binary_big_endian") return PlyFormat::big_endian;
  lines.fail_here("a PLY format is 'ascii 1.0', 'binary_little_endian 1.0' or 'binary_big_endian 1.0'");
}

PlyElement element_of(const TextLines& lines) {
  const auto& words = lines.words();
  if (words.size() != 3) lines.fail_here("a PLY element is 'element NAME COUNT'");
  PlyElement element{std::string(words[1]), 0, {}};
  const auto [stop, error] =
      std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
  if (error != std::errc{} || stop != words[2].data() + words[2].size() || element.count > INT32_MAX)
    lines.fail_here(fmt::format("'{}' is not a possible number of elements", words[2]));
  return element;
}

PlyProperty property_of(const TextLines& lines) {
  const auto& words = lines.words();
  const bool list = words.size() == 5 && words[1] == "list";
  if (!list && words.size() != 3)
    lines.fail_here("a PLY property is 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
  PlyProperty property;
  property.name = words.back();
  property.is_list = list;
  property.type = scalar_named(lines, words[list ? 3 : 1]);
  if (list) property.count_type = scalar_named(lines, words[2]);
  if (list && (property.count_type == PlyScalar::float32 || property.count_type == PlyScalar::float64))
    lines.fail_here("the length of a list must be a whole number");
  return property;
}

/// The least that the elements take: in text a digit and a separator a number.
void check_size(const std::string& file, const PlyHeader& header, std::uint64_t available) {
  std::uint64_t needed = 0;
  for (const PlyElement& element : header.elements) {
    std::uint64_t least = 0;
    for (const PlyProperty& property : element.properties)
      least += header.format == PlyFormat::ascii
                   ? 2
                   : bytes(property.is_list ? property.count_type : property.type);
    needed += least * element.count;
  }
  // The last line of a text needs no end.
  if (needed > available + 1)
    fail("'{}' is truncated: at least {} bytes are announced, {} are there", file, needed, available);
}

}  // namespace

std::size_t bytes(PlyScalar scalar) {
  switch (scalar) {
    case PlyScalar::int8:
    case PlyScalar::uint8:
      return 1;
    case PlyScalar::int16:
    case PlyScalar::uint16:
      return 2;
    case PlyScalar::float64:
      return 8;
    default:
      return 4;
  }
}

PlyHeader read_ply_header(const std::string& file, std::string_view content) {
  const std::size_t end = content.find("end_header");
  const std::size_t newline = end == std::string_view::npos ? end : content.find('\n', end);
  if (newline == std::string_view::npos) fail("'{}' has no complete PLY header", file);
  PlyHeader header;
  header.body = newline + 1;
  const std::string_view text = content.substr(0, end);
  header.body_line = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;

  TextLines lines(file, text);
  if (!lines.next() || lines.words().front() != "ply") fail("{}:1: a PLY file starts with 'ply'", file);
  bool has_format = false;
  while (lines.next()) {
    const std::string_view keyword = lines.words().front();
    if (keyword == "format") {
      header.format = format_of(lines);
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(element_of(lines));
    } else if (keyword == "property") {
      if (header.elements.empty()) lines.fail_here("a property stands before the first element");
      header.elements.back().properties.push_back(property_of(lines));
    } else if (keyword != "comment" && keyword != "obj_info") {
      lines.fail_here(fmt::format("'{}' does not belong into a PLY header", keyword));
    }
  }
  if (!has_format) lines.fail_here("the PLY header names no format");
  check_size(file, header, content.size() - header.body);
  return header;
}

}  // namespace radiosity

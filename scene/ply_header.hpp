#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace radiosity {

enum class PlyScalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t bytes(PlyScalar scalar);

struct PlyProperty {
  std::string name;
  PlyScalar type = PlyScalar::float32;
  bool is_list = false;
  PlyScalar count_type = PlyScalar::uint8;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyFormat { ascii, little_endian, big_endian };

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::size_t body = 0;       ///< offset of the first byte after the header
  std::size_t body_line = 0;  ///< number of lines before it
};

/// Throws Error "file:line: ..." for what is no PLY header, and for counts that cannot fit into the size of
/// the file.
PlyHeader read_ply_header(const std::string& file, std::string_view content);

}  // namespace radiosity

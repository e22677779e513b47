#include "compression/dds_file.hpp"

#include "foundation/error.hpp"
#include "foundation/output_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

namespace radiosity {
namespace {

// The header: 32 words of 4 bytes, the lowest byte first, at these places (Microsoft, "DDS_HEADER
// structure").
using DdsHeader = std::array<std::uint32_t, 32>;
enum DdsWord : std::size_t {
  magic_word = 0,
  size_word = 1,
  flags_word = 2,
  height_word = 3,
  width_word = 4,
  data_size_word = 5,
  mipmaps_word = 7,
  format_size_word = 19,
  format_flags_word = 20,
  four_cc_word = 21,
  caps_word = 27
};
constexpr std::uint32_t dds_header_size = 124;  // without the first word
constexpr std::uint32_t dds_format_size = 32;
constexpr std::uint32_t dds_flags =
    0x1 | 0x2 | 0x4 | 0x1000 | 0x80000;  // sizes, format and data size are given
constexpr std::uint32_t dds_has_four_cc = 0x4;
constexpr std::uint32_t dds_is_texture = 0x1000;
constexpr std::size_t block_bytes = 8;

constexpr std::uint32_t four_cc(std::string_view name) {
  std::uint32_t code = 0;
  for (std::size_t k = 0; k < 4; ++k) code |= std::uint32_t{static_cast<unsigned char>(name[k])} << (8 * k);
  return code;
}

template <typename Block>
struct DdsKind;
template <>
struct DdsKind<Bc1Block> {
  static constexpr std::string_view name = "DXT1";
  static constexpr std::array<std::uint32_t, 1> codes = {four_cc("DXT1")};
};
template <>
struct DdsKind<Bc4Block> {
  static constexpr std::string_view name = "ATI1 or BC4U";
  static constexpr std::array<std::uint32_t, 2> codes = {four_cc("ATI1"), four_cc("BC4U")};
};

using BlockBytes = std::array<unsigned char, block_bytes>;

BlockBytes bytes_of(std::uint64_t number) {
  BlockBytes bytes{};
  for (std::size_t k = 0; k < block_bytes; ++k) bytes[k] = static_cast<unsigned char>(number >> (8 * k));
  return bytes;
}

BlockBytes bytes_of(const Bc1Block& block) {
  return bytes_of(std::uint64_t{block.first} | std::uint64_t{block.second} << 16U |
                  std::uint64_t{block.indices} << 32U);
}

BlockBytes bytes_of(const Bc4Block& block) {
  BlockBytes bytes = {block.first, block.second};
  std::copy(block.indices.begin(), block.indices.end(), bytes.begin() + 2);
  return bytes;
}

void from_bytes(const BlockBytes& bytes, Bc1Block& block) {
  std::uint64_t number = 0;
  for (std::size_t k = 0; k < block_bytes; ++k) number |= std::uint64_t{bytes[k]} << (8 * k);
  block = {static_cast<std::uint16_t>(number), static_cast<std::uint16_t>(number >> 16U),
           static_cast<std::uint32_t>(number >> 32U)};
}

void from_bytes(const BlockBytes& bytes, Bc4Block& block) {
  block.first = bytes[0];
  block.second = bytes[1];
  std::copy(bytes.begin() + 2, bytes.end(), block.indices.begin());
}

std::string printable(std::uint32_t code) {
  std::string name;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto letter = static_cast<char>(code >> (8 * k) & 0xffU);
    name += letter >= ' ' && letter <= '~' ? letter : '?';
  }
  return name;
}

/// Reads the header of a DDS file; throws what read_dds says.
DdsHeader read_header(std::ifstream& in, const std::string& file) {
  std::array<unsigned char, 4 * std::tuple_size_v<DdsHeader>> bytes{};
  in.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
  const bool whole = static_cast<bool>(in);
  DdsHeader header{};
  for (std::size_t k = 0; k < bytes.size(); ++k) header[k / 4] |= std::uint32_t{bytes[k]} << (8 * (k % 4));
  if (header[magic_word] != four_cc("DDS ")) fail("'{}' is not a DDS file", file);
  if (!whole) fail("'{}' is truncated in its header", file);
  if (header[size_word] != dds_header_size || header[format_size_word] != dds_format_size)
    fail("'{}' is corrupted: the sizes in its header are {} and {}, {} and {} are right", file,
         header[size_word], header[format_size_word], dds_header_size, dds_format_size);
  return header;
}

template <typename Block>
void require_kind(const DdsHeader& header, const std::string& file) {
  const auto& codes = DdsKind<Block>::codes;
  if ((header[format_flags_word] & dds_has_four_cc) == 0)
    fail("'{}' holds texels that are not compressed; {} is read here", file, DdsKind<Block>::name);
  if (std::find(codes.begin(), codes.end(), header[four_cc_word]) == codes.end())
    fail("'{}' holds blocks of kind '{}'; {} is read here", file, printable(header[four_cc_word]),
         DdsKind<Block>::name);
  if (header[mipmaps_word] > 1)
    fail("'{}' holds {} sizes of one picture (mipmaps); save it with one", file, header[mipmaps_word]);
}

/// The number of blocks that a header announces, which the rest of the file must have.
std::size_t announced_blocks(const DdsHeader& header, std::uint64_t rest, const std::string& file) {
  const std::uint64_t width = header[width_word], height = header[height_word];
  constexpr std::uint64_t most = std::numeric_limits<int>::max();
  if (width == 0 || height == 0 || width > most || height > most)
    fail("'{}' announces {} x {} texels: it is empty or corrupted", file, width, height);
  const std::uint64_t blocks = (width + 3) / 4 * ((height + 3) / 4);
  if (blocks * block_bytes != rest)
    fail("'{}' is {}: {} x {} texels take {} bytes after the header, {} are there", file,
         rest < blocks * block_bytes ? "truncated" : "corrupted", width, height, blocks * block_bytes, rest);
  return blocks;
}

}  // namespace

template <typename Block>
void write_dds(const std::filesystem::path& file, const BlockTexture<Block>& texture) {
  if (texture.width < 1 || texture.height < 1 ||
      texture.blocks.size() != texture.block_columns() * texture.block_rows())
    fail<UsageError>("a texture of {} x {} texels cannot be written with {} blocks of 4 x 4", texture.width,
                     texture.height, texture.blocks.size());
  DdsHeader header{};
  header[magic_word] = four_cc("DDS ");
  header[size_word] = dds_header_size;
  header[flags_word] = dds_flags;
  header[height_word] = static_cast<std::uint32_t>(texture.height);
  header[width_word] = static_cast<std::uint32_t>(texture.width);
  // As the format has it in 32 bits; the sizes above are what counts.
  header[data_size_word] = static_cast<std::uint32_t>(texture.blocks.size() * block_bytes);
  header[format_size_word] = dds_format_size;
  header[format_flags_word] = dds_has_four_cc;
  header[four_cc_word] = DdsKind<Block>::codes.front();
  header[caps_word] = dds_is_texture;

  OutputFile output(file);
  for (const std::uint32_t word : header)
    output.stream().write(reinterpret_cast<const char*>(bytes_of(word).data()), sizeof(word));
  for (const Block& block : texture.blocks)
    output.stream().write(reinterpret_cast<const char*>(bytes_of(block).data()), block_bytes);
  output.commit();
}

template <typename Block>
BlockTexture<Block> read_dds(const std::filesystem::path& path) {
  const std::string file = path.string();
  std::error_code no_size;
  const std::uint64_t size = std::filesystem::file_size(path, no_size);
  std::ifstream in(path, std::ios::binary);
  if (no_size || !in) fail("cannot read '{}': {}", file, no_size ? no_size.message() : std::strerror(errno));
  const DdsHeader header = read_header(in, file);
  require_kind<Block>(header, file);
  BlockTexture<Block> texture;
  texture.blocks.resize(announced_blocks(header, size - sizeof(DdsHeader), file));
  texture.width = static_cast<int>(header[width_word]);
  texture.height = static_cast<int>(header[height_word]);
  for (Block& block : texture.blocks) {
    BlockBytes bytes{};
    in.read(reinterpret_cast<char*>(bytes.data()), block_bytes);
    from_bytes(bytes, block);
  }
  if (!in) fail("'{}' could not be read to its end", file);
  return texture;
}

template void write_dds(const std::filesystem::path&, const BlockTexture<Bc1Block>&);
template void write_dds(const std::filesystem::path&, const BlockTexture<Bc4Block>&);
template BlockTexture<Bc1Block> read_dds(const std::filesystem::path&);
template BlockTexture<Bc4Block> read_dds(const std::filesystem::path&);

}  // namespace radiosity

#pragma once

#include "kernels/block_formats.hpp"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace radiosity {

/// A picture of width x height texels in blocks of 4 x 4 by rows; where a size is no multiple of 4, the last
/// blocks reach beyond it. Block is Bc1Block or Bc4Block.
template <typename Block>
struct BlockTexture {
  int width = 0;
  int height = 0;
  std::vector<Block> blocks;

  std::size_t block_columns() const { return (static_cast<std::size_t>(width) + 3) / 4; }
  std::size_t block_rows() const { return (static_cast<std::size_t>(height) + 3) / 4; }
};

/// Writes a DirectDraw Surface without smaller copies: FourCC DXT1 (BC1) or ATI1 (BC4). Appears whole or not
/// at all. Throws UsageError unless there are texels and as many blocks as they need.
template <typename Block>
void write_dds(const std::filesystem::path& file, const BlockTexture<Block>& texture);

/// Reads one of blocks of the given kind, BC4 as ATI1 or BC4U. Throws Error, naming the file, for anything
/// else, for smaller copies (mipmaps) and where the file's size is not what its header says.
template <typename Block>
BlockTexture<Block> read_dds(const std::filesystem::path& file);

extern template void write_dds(const std::filesystem::path&, const BlockTexture<Bc1Block>&);
extern template void write_dds(const std::filesystem::path&, const BlockTexture<Bc4Block>&);
extern template BlockTexture<Bc1Block> read_dds(const std::filesystem::path&);
extern template BlockTexture<Bc4Block> read_dds(const std::filesystem::path&);

}  // namespace radiosity

#include "compression/dds_file.hpp"
#include "foundation/error.hpp"
#include "foundation/random.hpp"
#include "tests/temporary_folder.hpp"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace radiosity {
namespace {

namespace fs = std::filesystem;

Bc1Block random_block(RandomStream& random, const Bc1Block&) {
  Bc1Block block{static_cast<std::uint16_t>(random.below(65536)),
                 static_cast<std::uint16_t>(random.below(65536)), static_cast<std::uint32_t>(random())};
  if (block.first < block.second) std::swap(block.first, block.second);  // four colours
  return block;
}

Bc4Block random_block(RandomStream& random, const Bc4Block&) {
  Bc4Block block;
  block.first = static_cast<std::uint8_t>(random.below(256));
  block.second = static_cast<std::uint8_t>(random.below(256));
  for (std::uint8_t& byte : block.indices) byte = static_cast<std::uint8_t>(random.below(256));
  return block;
}

template <typename Block>
BlockTexture<Block> random_texture(int width, int height) {
  BlockTexture<Block> texture{width, height, {}};
  RandomStream random(21);
  texture.blocks.resize(texture.block_columns() * texture.block_rows());
  for (Block& block : texture.blocks) block = random_block(random, block);
  return texture;
}

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

template <typename Block>
std::string refusal(const fs::path& file) {
  try {
    read_dds<Block>(file);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/// The texels of a file as another library sees them: by rows, all channels of a texel together.
struct ForeignPicture {
  int width = 0, height = 0, channels = 0;
  std::vector<unsigned char> texels;

  explicit ForeignPicture(const fs::path& file) {
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input) return;
    width = input->spec().width;
    height = input->spec().height;
    channels = input->spec().nchannels;
    texels.resize(static_cast<std::size_t>(width * height * channels));
    if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, texels.data())) texels.clear();
  }

  double at(int x, int y, int channel) const {
    return texels.at(static_cast<std::size_t>((y * width + x) * channels + channel));
  }
};

template <typename Block>
struct PlaceInBlock {
  const Block& block;
  int texel;

  PlaceInBlock(const BlockTexture<Block>& texture, int x, int y)
      : block(texture.blocks[static_cast<std::size_t>(y / 4) * texture.block_columns() +
                             static_cast<std::size_t>(x / 4)]),
        texel(4 * (y % 4) + x % 4) {}
};

TEST(DdsFile, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  const auto round_trip = [&](const auto& texture) {
    using Block = typename std::decay_t<decltype(texture.blocks)>::value_type;
    write_dds(folder.path() / "a.dds", texture);
    const auto read = read_dds<Block>(folder.path() / "a.dds");
    EXPECT_EQ(read.width, texture.width);
    EXPECT_EQ(read.height, texture.height);
    EXPECT_EQ(read.blocks, texture.blocks);
    EXPECT_EQ(fs::file_size(folder.path() / "a.dds"), 128 + 8 * texture.blocks.size());
  };
  for (const auto& [width, height] :
       {std::pair(1, 1), std::pair(4, 4), std::pair(13, 6), std::pair(64, 32)}) {
    round_trip(random_texture<Bc1Block>(width, height));
    round_trip(random_texture<Bc4Block>(width, height));
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1) << "nothing temporary is left";
}

TEST(DdsFile, AnotherLibrarySeesTheSameColours) {
  const TemporaryFolder folder;
  const auto texture = random_texture<Bc1Block>(22, 14);
  write_dds(folder.path() / "colours.dds", texture);
  const ForeignPicture picture(folder.path() / "colours.dds");
  ASSERT_EQ(picture.width, 22);
  ASSERT_EQ(picture.height, 14);
  ASSERT_GE(picture.channels, 3);
  double worst = 0, exchanged = 0;
  for (int y = 0; y < 14; ++y)
    for (int x = 0; x < 22; ++x) {
      const PlaceInBlock place(texture, x, y);
      const Bc1Palette palette = bc1_palette(place.block);
      const auto& colour = palette[static_cast<std::size_t>(bc1_index(place.block, place.texel))];
      for (int c = 0; c < 3; ++c) {
        worst = std::max(worst, std::abs(picture.at(x, y, c) - colour[static_cast<std::size_t>(c)]));
        exchanged =
            std::max(exchanged, std::abs(picture.at(x, y, 2 - c) - colour[static_cast<std::size_t>(c)]));
      }
    }
  EXPECT_LE(worst, 1.5);     // ends and thirds are rounded or cut to whole numbers
  EXPECT_GT(exchanged, 50);  // red and blue in each other's place would be seen
}

TEST(DdsFile, AnotherLibrarySeesTheSameNumbers) {
  const TemporaryFolder folder;
  const auto texture = random_texture<Bc4Block>(9, 8);
  write_dds(folder.path() / "numbers.dds", texture);
  const ForeignPicture picture(folder.path() / "numbers.dds");
  ASSERT_EQ(picture.width, 9);
  ASSERT_EQ(picture.height, 8);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 9; ++x) {
      const PlaceInBlock place(texture, x, y);
      const std::array<double, 8> palette = bc4_palette(place.block);
      EXPECT_NEAR(picture.at(x, y, 0), palette[static_cast<std::size_t>(bc4_index(place.block, place.texel))],
                  1);
    }
}

TEST(DdsFile, TruncatedFilesAreRefused) {
  const TemporaryFolder folder;
  write_dds(folder.path() / "whole.dds", random_texture<Bc1Block>(8, 8));
  const std::string whole = content_of(folder.path() / "whole.dds");
  for (std::size_t size = 0; size < whole.size(); size += 3) {
    const std::string said = refusal<Bc1Block>(folder.write("cut.dds", whole.substr(0, size)));
    EXPECT_NE(said.find("cut.dds' is "), std::string::npos) << size << ": " << said;
  }
  EXPECT_NE(refusal<Bc1Block>(folder.write("long.dds", whole + "x")).find("corrupted"), std::string::npos);
  EXPECT_EQ(refusal<Bc1Block>(folder.write("same.dds", whole)), "no error");
}

TEST(DdsFile, ACorruptedHeaderIsRefusedOrHarmless) {
  const TemporaryFolder folder;
  write_dds(folder.path() / "whole.dds", random_texture<Bc1Block>(8, 8));
  const std::string whole = content_of(folder.path() / "whole.dds");
  const auto with = [&](std::size_t at, const std::string& bytes) {
    return refusal<Bc1Block>(
        folder.write("changed.dds", std::string(whole).replace(at, bytes.size(), bytes)));
  };
  const std::string huge(4, '\xff'), none(4, '\0');
  EXPECT_NE(with(0, "PNG ").find("not a DDS file"), std::string::npos);
  EXPECT_NE(with(4, huge).find("corrupted"), std::string::npos);
  EXPECT_NE(with(12, none).find("empty or corrupted"), std::string::npos);
  EXPECT_NE(with(16, huge).find("empty or corrupted"), std::string::npos);
  EXPECT_NE(with(12, "\xff\xff\xff\x7f").find("truncated"), std::string::npos);
  EXPECT_NE(with(28, huge).find("mipmaps"), std::string::npos);
  EXPECT_NE(with(80, none).find("not compressed"), std::string::npos);
  EXPECT_NE(with(84, "DX10").find("'DX10'"), std::string::npos);
  for (std::size_t at = 0; at < 128; ++at) {
    const std::string said = with(at, "\xff");
    EXPECT_TRUE(said == "no error" || said.find("changed.dds'") != std::string::npos) << at << ": " << said;
  }
}

TEST(DdsFile, OtherKindsAndMissingFilesAreRefused) {
  const TemporaryFolder folder;
  const auto texture = random_texture<Bc4Block>(8, 8);
  write_dds(folder.path() / "bc4.dds", texture);
  EXPECT_NE(refusal<Bc1Block>(folder.path() / "bc4.dds").find("'ATI1'"), std::string::npos);
  const std::string other_name = content_of(folder.path() / "bc4.dds").replace(84, 4, "BC4U");
  EXPECT_EQ(read_dds<Bc4Block>(folder.write("bc4u.dds", other_name)).blocks, texture.blocks);
  EXPECT_NE(refusal<Bc4Block>(folder.path() / "none.dds").find("cannot read"), std::string::npos);
  EXPECT_NE(refusal<Bc4Block>(folder.path()).find("cannot read"), std::string::npos);
}

TEST(DdsFile, SizesThatDoNotFitAreNotWritten) {
  const TemporaryFolder folder;
  auto texture = random_texture<Bc1Block>(8, 8);
  texture.blocks.pop_back();
  EXPECT_THROW(write_dds(folder.path() / "a.dds", texture), UsageError);
  EXPECT_THROW(write_dds(folder.path() / "a.dds", BlockTexture<Bc1Block>{0, 4, {}}), UsageError);
  EXPECT_THROW(write_dds(folder.path() / "a.dds", BlockTexture<Bc1Block>{-3, 4, {}}), UsageError);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace radiosity

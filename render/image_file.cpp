#include "render/image_file.hpp"

#include "foundation/error.hpp"
#include "foundation/output_file.hpp"

#include <OpenImageIO/imageio.h>

namespace radiosity {
namespace {

void write_image(const std::filesystem::path& file, const OIIO::ImageSpec& spec, const void* pixels) {
  OutputFile output(file);
  const std::string name = output.temporary_path().string();
  const auto writer = OIIO::ImageOutput::create(name);
  if (!writer) fail("cannot write '{}': {}", file.string(), OIIO::geterror());
  if (!writer->open(name, spec) || !writer->write_image(spec.format, pixels) || !writer->close())
    fail("cannot write '{}': {}", file.string(), writer->geterror());
  output.commit();
}

}  // namespace

void write_exr(const std::filesystem::path& file, const Picture& picture) {
  OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::FLOAT);
  spec.attribute("oiio:ColorSpace", "linear");
  spec.attribute("compression", "zip");
  write_image(file, spec, picture.pixels.data());
}

void write_png(const std::filesystem::path& file, int width, int height,
               const std::vector<std::uint8_t>& bytes) {
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  write_image(file, spec, bytes.data());
}

}  // namespace radiosity

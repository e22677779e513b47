#include "render/image_writer/image_writer.hpp"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <string>

namespace {

std::string written(const char* file, const radiosity::ImageToWrite& image) {
  OIIO::ImageSpec spec(image.width, image.height, 3,
                       image.floats ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", image.floats ? "linear" : "sRGB");
  if (image.floats) spec.attribute("compression", "zip");
  const auto writer = OIIO::ImageOutput::create(file);
  if (!writer) return OIIO::geterror();
  if (!writer->open(file, spec) || !writer->write_image(spec.format, image.pixels) || !writer->close())
    return writer->geterror();
  return {};
}

}  // namespace

bool radiosity_write_image(const char* file, const radiosity::ImageToWrite* image, char* error,
                           std::size_t error_size) {
  const std::string message = written(file, *image);
  const std::size_t length = std::min(message.size(), error_size - 1);
  std::memcpy(error, message.data(), length);
  error[length] = '\0';
  return message.empty();
}

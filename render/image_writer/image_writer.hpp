#pragma once

#include <cstddef>

/// What render/image_file.cpp and the module radiosity_image_writer.so agree on. The module is loaded when
/// the first picture is written: OpenImageIO brings 250 shared libraries, and a program linked to it takes a
/// quarter of a second to start.

namespace radiosity {

/// Three channels a pixel, row by row from the top.
struct ImageToWrite {
  int width;
  int height;
  bool floats;         ///< float32, linear, as OpenEXR; otherwise bytes, sRGB, as PNG
  const void* pixels;  ///< 3 width height numbers
};

}  // namespace radiosity

/// Writes an image in the format that the file's extension names; false if it cannot, with the reason in
/// error (cut to error_size bytes, ended by zero).
extern "C" bool radiosity_write_image(const char* file, const radiosity::ImageToWrite* image, char* error,
                                      std::size_t error_size);

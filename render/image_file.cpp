#include "render/image_file.hpp"

#include "foundation/error.hpp"
#include "foundation/output_file.hpp"
#include "render/image_writer/image_writer.hpp"

#include <array>
#include <dlfcn.h>
#include <string>

namespace radiosity {
namespace {

struct ImageWriter {
  decltype(&radiosity_write_image) write = nullptr;
  std::string why_not;
};

/// The module stays loaded: its libraries have threads and static objects that do not survive dlclose.
ImageWriter load_image_writer() {
  void* const module = dlopen("radiosity_image_writer.so", RTLD_NOW | RTLD_LOCAL);
  void* const function = module != nullptr ? dlsym(module, "radiosity_write_image") : nullptr;
  if (function == nullptr) return {nullptr, dlerror()};
  return {reinterpret_cast<decltype(&radiosity_write_image)>(function), {}};
}

const ImageWriter& image_writer() {
  static const ImageWriter writer = load_image_writer();
  return writer;
}

void write_image(const std::filesystem::path& file, const ImageToWrite& image) {
  const ImageWriter& writer = image_writer();
  if (writer.write == nullptr)
    fail(
        "cannot write '{}': the module that writes pictures cannot be loaded ({}); it belongs into "
        "lib/radiosity of the "
        "installation, or LD_LIBRARY_PATH has to name its folder",
        file.string(), writer.why_not);
  OutputFile output(file);
  std::array<char, 512> error;
  if (!writer.write(output.temporary_path().c_str(), &image, error.data(), error.size()))
    fail("cannot write '{}': {}", file.string(), error.data());
  output.commit();
}

}  // namespace

void write_exr(const std::filesystem::path& file, const Picture& picture) {
  write_image(file, {picture.width, picture.height, true, picture.pixels.data()});
}

void write_png(const std::filesystem::path& file, int width, int height,
               const std::vector<std::uint8_t>& bytes) {
  write_image(file, {width, height, false, bytes.data()});
}

}  // namespace radiosity

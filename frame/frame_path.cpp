#include "frame/frame_path.hpp"

#include "render/bounding_box.hpp"
#include "render/camera_rays.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

namespace radiosity {
namespace {

constexpr double part_of_width = 0.25;  // half axes, of the sides of the box
constexpr double part_of_height = 0.8;

/// Throws UsageError for what is no finite number.
std::vector<double> numbers_of(const std::string& line, const std::string& where) {
  constexpr const char* spaces = " \t\r,";
  std::vector<double> numbers;
  const std::string text = line.substr(0, line.find('#'));
  for (std::size_t begin = text.find_first_not_of(spaces); begin != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_of(spaces, begin), text.size());
    double number = 0;
    const auto [last, error] = std::from_chars(text.data() + begin, text.data() + end, number);
    if (error != std::errc{} || last != text.data() + end || !std::isfinite(number))
      fail<UsageError>("{}: '{}' is not a number", where, text.substr(begin, end - begin));
    numbers.push_back(number);
    begin = text.find_first_not_of(spaces, end);
  }
  return numbers;
}

FrameView view_of(const std::vector<double>& numbers, const std::string& where) {
  if (numbers.size() != 3 && numbers.size() != 9)
    fail<UsageError>(
        "{}: there are {} numbers; a line has the light's position (3), or light, camera and its target (9)",
        where, numbers.size());
  const auto three = [&](std::size_t first) {
    return Vector3(numbers[first], numbers[first + 1], numbers[first + 2]);
  };
  FrameView view{three(0), {}, {}};
  if (numbers.size() == 9) {
    view.camera = three(3);
    view.target = three(6);
    if (*view.target == *view.camera)
      fail<UsageError>("{}: the camera stands where it looks at, so that it has no direction", where);
  }
  return view;
}

}  // namespace

std::vector<FrameView> orbit_path(const PatchMesh& mesh, int frames) {
  if (frames < 1) fail<UsageError>("{} frames are too few; at least one is needed", frames);
  const Eigen::AlignedBox3d box = bounding_box(mesh);
  const Vector3 size = box.sizes();
  std::vector<FrameView> views;
  views.reserve(static_cast<std::size_t>(frames));
  for (int frame = 0; frame < frames; ++frame) {
    const double angle = 2 * std::numbers::pi * frame / frames;
    const Vector3 place(part_of_width * size.x() * std::cos(angle), (part_of_height - 0.5) * size.y(),
                        part_of_width * size.z() * std::sin(angle));
    views.push_back({box.center() + place, {}, {}});
  }
  return views;
}

std::vector<FrameView> read_frame_path(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) fail<UsageError>("cannot read the path '{}': give orbit or a file", file.string());
  std::vector<FrameView> views;
  int line_number = 0;
  for (std::string line; std::getline(stream, line);) {
    const std::string where = fmt::format("{}, line {}", file.string(), ++line_number);
    const std::vector<double> numbers = numbers_of(line, where);
    if (!numbers.empty()) views.push_back(view_of(numbers, where));
  }
  if (views.empty()) fail<UsageError>("the path '{}' has no line with a light's position", file.string());
  return views;
}

Camera camera_of(const FrameView& view, const PatchMesh& mesh) {
  Camera camera = mesh.scene && mesh.scene->camera ? *mesh.scene->camera : default_camera(mesh);
  if (view.camera) {
    camera.position = *view.camera;
    camera.target = *view.target;
  }
  return camera;
}

}  // namespace radiosity

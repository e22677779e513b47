#include "foundation/error.hpp"
#include "scene/import_formats.hpp"
#include "scene/imported_faces.hpp"
#include "scene/text_lines.hpp"

#include <cstdint>
#include <cstring>

// A reader of our own: the library that reads glTF leaks memory on damaged STL text.

namespace radiosity {
namespace {

constexpr std::size_t kHeader = 84,
                      kFacet = 50;  // bytes; a facet is normal, three corners, two bytes of attributes

std::uint64_t binary_facets(std::string_view content) {
  if (content.size() < kHeader) return 0;
  std::uint32_t count = 0;
  std::memcpy(&count, content.data() + kHeader - sizeof count, sizeof count);
  return count;
}

void read_binary(const std::string& file, std::string_view content, ImportedFaces& faces) {
  std::vector<Vector3>& vertices = faces.scene().vertices;
  const std::uint64_t count = binary_facets(content);
  for (std::uint64_t facet = 0; facet < count; ++facet) {
    const auto first = static_cast<int>(vertices.size());
    std::array<float, 9> numbers{};
    std::memcpy(numbers.data(), content.data() + kHeader + facet * kFacet + 12, sizeof numbers);
    for (std::size_t k = 0; k < 9; k += 3) {
      vertices.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2]);
      if (!vertices.back().allFinite()) fail("'{}': facet {} has a corner that is not finite", file, facet);
    }
    faces.polygon({first, first + 1, first + 2}, 0, faces.group("default"));
  }
}

void read_text(const std::string& file, std::string_view content, ImportedFaces& faces) {
  std::vector<Vector3>& vertices = faces.scene().vertices;
  TextLines lines(file, content);
  std::string solid;
  std::size_t corners = 0;
  bool ended = false;
  while (lines.next()) {
    const auto& words = lines.words();
    ended = words[0] == "endsolid";
    if (words[0] == "solid") solid = lines.remainder();
    if (words[0] == "vertex") {
      if (words.size() != 4) lines.fail_here("a vertex needs three numbers; the line may be truncated");
      vertices.emplace_back(lines.finite_number(1), lines.finite_number(2), lines.finite_number(3));
      ++corners;
    }
    if (words[0] != "endloop") continue;
    if (corners != 3) lines.fail_here(fmt::format("a facet has {} corners instead of three", corners));
    const auto first = static_cast<int>(vertices.size()) - 3;
    faces.polygon({first, first + 1, first + 2}, 0, faces.group(solid.empty() ? "default" : solid));
    corners = 0;
  }
  if (!ended) lines.fail_here("the file ends before 'endsolid': it may be truncated");
}

}  // namespace

Scene import_stl(const std::filesystem::path& path) {
  const std::string file = path.string();
  const std::string content = read_text(file);
  ImportedFaces faces(path.stem().string());
  faces.scene().materials.push_back({"default", Color::Constant(0.5), Color::Zero()});
  // Binary files may start with "solid" too: their size tells.
  const std::uint64_t needed = kHeader + kFacet * binary_facets(content);
  if (content.size() >= kHeader && needed == content.size())
    read_binary(file, content, faces);
  else if (content.compare(0, 5, "solid") == 0)
    read_text(file, content, faces);
  else
    fail("'{}' is truncated: {} bytes are announced, {} are there", file, needed, content.size());
  return faces.finish(file);
}

}  // namespace radiosity

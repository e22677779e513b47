#include "foundation/error.hpp"
#include "scene/import_formats.hpp"
#include "scene/imported_faces.hpp"
#include "scene/mtl_scan.hpp"
#include "scene/obj_scan.hpp"
#include "scene/text_lines.hpp"

#ifndef TINYOBJLOADER_USE_DOUBLE
#define TINYOBJLOADER_USE_DOUBLE  // as the library linked here was built
#endif
#include <tiny_obj_loader.h>

#include <numbers>
#include <sstream>

namespace radiosity {
namespace {

/// Blanks out comments behind statements, which the parser takes for part of them.
std::string without_comments(std::string text) {
  bool comment = false;
  char before = '\n';
  for (char& c : text) {
    const bool line_end = c == '\n' || c == '\r';
    const bool after_blank = before == '\n' || before == '\r' || before == ' ' || before == '\t';
    comment = !line_end && (comment || (c == '#' && after_blank));
    before = c;
    if (comment) c = ' ';
  }
  return text;
}

/// Reads material libraries beside the OBJ file; a missing one is a note.
class Libraries final : public tinyobj::MaterialReader {
 public:
  explicit Libraries(std::filesystem::path folder) : folder_(std::move(folder)) {}

  bool operator()(const std::string& name, std::vector<tinyobj::material_t>*, std::map<std::string, int>*,
                  std::string*, std::string*) override {
    const std::filesystem::path file = folder_ / name;
    if (!std::filesystem::is_regular_file(file)) {
      notes.push_back(
          fmt::format("material library '{}' is missing: its materials have reflectance 0.5", name));
      return true;
    }
    for (const auto& [material, entry] : scan_mtl(file.string(), read_text(file.string())))
      entries[material] = entry;
    return true;
  }

  std::map<std::string, MtlEntry> entries;
  std::vector<std::string> notes;

 private:
  std::filesystem::path folder_;
};

std::vector<tinyobj::shape_t> parse(const std::string& file, const std::string& text, Libraries& libraries) {
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  std::istringstream stream(without_comments(text));
  const bool triangulate = false;
  if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &stream, &libraries, triangulate))
    fail("'{}' cannot be read: {}", file, error.substr(0, error.find('\n')));
  return shapes;
}

/// The materials that faces use, by their names; what is not in a library has reflectance 0.5.
void add_materials(Scene& scene, const ObjScan& scan, const Libraries& libraries) {
  std::size_t undefined = 0, textured = 0;
  for (const std::string& name : scan.material_names) {
    Material material;
    material.name = name.empty() ? "default" : name;
    const auto entry = libraries.entries.find(name);
    undefined += !name.empty() && entry == libraries.entries.end();
    if (entry != libraries.entries.end()) {
      if (entry->second.diffuse) material.reflectance = *entry->second.diffuse;
      material.emission = std::numbers::pi * entry->second.emission;
      textured += entry->second.has_texture;
    }
    scene.materials.push_back(material);
  }
  if (undefined > 0)
    scene.notes.push_back(fmt::format("{} materials are used but not defined: reflectance 0.5", undefined));
  if (textured > 0)
    scene.notes.push_back(fmt::format("{} materials have textures, which are left out: Kd counts", textured));
}

}  // namespace

Scene import_obj(const std::filesystem::path& path) {
  const std::string file = path.string();
  const std::string text = read_text(file);
  ObjScan scan = scan_obj(file, text);
  if (scan.faces.empty()) fail("'{}' has no faces: nothing to light", file);
  Libraries libraries(path.parent_path());
  const std::vector<tinyobj::shape_t> shapes = parse(file, text, libraries);

  ImportedFaces faces(path.stem().string());
  Scene& scene = faces.scene();
  // Not the parser's own numbers, whose last digits are not rounded correctly.
  scene.vertices = std::move(scan.vertices);
  scene.notes = libraries.notes;
  if (scan.unknown_lines > 0)
    scene.notes.push_back(
        fmt::format("{} lines are no OBJ statements and were left out, the first is line {}",
                    scan.unknown_lines, scan.first_unknown_line));
  add_materials(scene, scan, libraries);

  std::size_t line = 0;
  for (const tinyobj::shape_t& shape : shapes) {
    std::size_t start = 0;
    for (const std::size_t count : shape.mesh.num_face_vertices) {
      if (line == scan.faces.size()) fail("'{}' cannot be read: it has more faces than face lines", file);
      std::vector<int> corners;
      for (std::size_t k = 0; k < count; ++k) {
        corners.push_back(shape.mesh.indices[start + k].vertex_index);
        if (corners.back() < 0 || static_cast<std::size_t>(corners.back()) >= scene.vertices.size())
          fail("'{}' cannot be read: a face refers to vertex {}", file, corners.back() + 1);
      }
      start += count;
      const auto& [group, material] = scan.faces[line++];
      faces.polygon(corners, material, faces.group(scan.group_names[static_cast<std::size_t>(group)]));
    }
  }
  if (line != scan.faces.size())
    fail("'{}' cannot be read: {} of its {} face lines are not faces", file, scan.faces.size() - line,
         scan.faces.size());
  return faces.finish(file);
}

}  // namespace radiosity

#include "scene/patch_mesh.hpp"

#include "foundation/error.hpp"
#include "foundation/hash.hpp"
#include "foundation/memory.hpp"
#include "scene/face_duplicates.hpp"
#include "scene/patch_division.hpp"
#include "scene/scene_validation.hpp"
#include "scene/vertex_welding.hpp"

#include <algorithm>

namespace radiosity {
namespace {

// Corners nearer than this, relative to the diagonal, are one vertex of the patch mesh.
constexpr double kSharedVertex = 1e-12;
// A face whose area is below this times its longest edge squared has no normal worth the name.
constexpr double kLeastRoundness = 1e-12;

bool has_area(const Scene& scene, const Face& face) {
  double longest = 0;
  for (int k = 0; k < face.corner_count; ++k)
    longest = std::max(
        longest, (corner(scene, face, (k + 1) % face.corner_count) - corner(scene, face, k)).squaredNorm());
  return area_vector(scene, face).norm() > kLeastRoundness * longest;
}

/// Which faces have an area; the others are told in a note.
std::vector<bool> faces_with_area(const Scene& scene, std::vector<std::string>& notes) {
  std::vector<bool> used;
  used.reserve(scene.faces.size());
  for (const Face& face : scene.faces) used.push_back(has_area(scene, face));
  const auto dropped = std::count(used.begin(), used.end(), false);
  const auto first = std::find(used.begin(), used.end(), false) - used.begin();
  if (dropped == static_cast<std::ptrdiff_t>(used.size())) fail("'{}' has no face with an area", scene.name);
  if (dropped > 0)
    notes.push_back(fmt::format("{} faces of zero area dropped, the first is face {}", dropped, first));
  return used;
}

/// The patches with their corners as one vertex each time.
void add_patches(PatchMesh& mesh, const Scene& scene, const Division& division) {
  std::vector<Vector3> corners;
  for (std::size_t f = 0; f < division.parts.size(); ++f)
    for (const Polygon& part : division.parts[f]) {
      Patch patch;
      patch.corner_count = static_cast<int>(part.size());
      patch.face = static_cast<int>(f);
      patch.group = scene.faces[f].group;
      patch.material = scene.faces[f].material;
      for (std::size_t k = 0; k < part.size(); ++k) {
        patch.corners[k] = static_cast<int>(corners.size());
        corners.push_back(part[k]);
      }
      mesh.patches.push_back(patch);
    }
  const std::vector<int> welded = weld(corners, kSharedVertex * diagonal(scene));
  std::vector<int> number(corners.size(), -1);
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (welded[i] == static_cast<int>(i)) {
      number[i] = static_cast<int>(mesh.vertices.size());
      mesh.vertices.push_back(corners[i]);
    }
  for (Patch& patch : mesh.patches)
    for (int k = 0; k < patch.corner_count; ++k) {
      int& vertex = patch.corners[static_cast<std::size_t>(k)];
      vertex = number[static_cast<std::size_t>(welded[static_cast<std::size_t>(vertex)])];
    }
  mesh.patches.shrink_to_fit();  // they stay, often by the million
  mesh.vertices.shrink_to_fit();
}

/// Area, normal and centroid, from the fan of triangles around the first corner.
void measure_patches(PatchMesh& mesh) {
  const Index n = mesh.patch_count();
  mesh.area.resize(n);
  mesh.normal.resize(3, n);
  mesh.centroid.resize(3, n);
  for (Index i = 0; i < n; ++i) {
    const int corner_count = mesh.patches[static_cast<std::size_t>(i)].corner_count;
    const Vector3& origin = mesh.corner(i, 0);
    Vector3 area = Vector3::Zero(), moment = Vector3::Zero();
    for (int k = 1; k + 1 < corner_count; ++k) {
      const Vector3 a = mesh.corner(i, k) - origin, b = mesh.corner(i, k + 1) - origin;
      const Vector3 triangle = 0.5 * a.cross(b);
      area += triangle;
      moment += triangle.norm() * (a + b) / 3;
    }
    mesh.area[i] = area.norm();
    mesh.normal.col(i) = area.normalized();
    mesh.centroid.col(i) = origin + moment / mesh.area[i];
  }
}

bool is_grey(const Color& color) {
  return color[0] == color[1] && color[1] == color[2];
}

/// One channel where every material in use is grey.
void colour_patches(PatchMesh& mesh, const Scene& scene) {
  const bool grey = std::all_of(mesh.patches.begin(), mesh.patches.end(), [&](const Patch& patch) {
    const Material& material = scene.materials[static_cast<std::size_t>(patch.material)];
    return is_grey(material.reflectance) && is_grey(material.emission);
  });
  const Index channels = grey ? 1 : 3;
  mesh.reflectance.resize(mesh.patch_count(), channels);
  mesh.emission.resize(mesh.patch_count(), channels);
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const Material& material =
        scene.materials[static_cast<std::size_t>(mesh.patches[static_cast<std::size_t>(i)].material)];
    mesh.reflectance.row(i) = material.reflectance.head(channels).transpose().matrix();
    mesh.emission.row(i) = material.emission.head(channels).transpose().matrix();
  }
}

/// What stands on faces, if it is to be cut out; a note where it is not.
Covers contacts_to_cut(const Scene& scene, const Subdivision& subdivision, std::vector<std::string>& notes) {
  if (scene.contacts == Contacts::never) return {};
  Covers covers = find_contacts(scene);
  const bool subdivided = subdivision.patches > 0 || subdivision.edge > 0;
  if (subdivided || scene.contacts == Contacts::always) return covers;
  const auto covered =
      std::count_if(covers.begin(), covers.end(), [](const auto& list) { return !list.empty(); });
  if (covered > 0)
    notes.push_back(
        fmt::format("{} faces are partly covered by what stands on them and stay whole, since each is one "
                    "patch; subdivide to cut them",
                    covered));
  return {};
}

bool any(const Covers& covers) {
  return std::any_of(covers.begin(), covers.end(), [](const auto& list) { return !list.empty(); });
}

/// make_patches() but for the division's blocks, one a patch, which are freed when it returns.
PatchMesh divided_mesh(const Scene& scene, const Subdivision& subdivision) {
  PatchMesh mesh;
  mesh.scene = std::make_shared<const Scene>(scene);
  mesh.notes = scene.notes;
  const std::vector<bool> used = faces_with_area(scene, mesh.notes);
  if (const DuplicateFaces duplicates = find_duplicates(scene); duplicates.count > 0)
    mesh.notes.push_back(fmt::format("{} faces are there twice and kept, the first is face {}",
                                     duplicates.count, duplicates.first));
  const Covers covers = contacts_to_cut(scene, subdivision, mesh.notes);
  const Division division = divide_faces(scene, used, covers, subdivision);
  if (division.dropped_pieces > 0)
    mesh.notes.push_back(
        fmt::format("{} remains beside contacts dropped, below 1e-9 of the cells they are cut from",
                    division.dropped_pieces));
  add_patches(mesh, scene, division);
  if (mesh.patches.empty())
    fail("the faces of '{}' cover each other completely: no patch is left", scene.name);
  measure_patches(mesh);
  colour_patches(mesh, scene);
  mesh.topology = topology(any(covers) ? without_contacts(scene) : scene);
  return mesh;
}

}  // namespace

PatchMesh make_patches(const Scene& scene, const Subdivision& subdivision) {
  validate(scene);
  PatchMesh mesh = divided_mesh(scene, subdivision);
  constexpr Index many = 100000;
  if (mesh.patch_count() > many) release_freed_memory();
  return mesh;
}

PatchMesh mesh_of_parts(const PatchMesh& other, std::vector<std::vector<Polygon>> parts) {
  PatchMesh mesh;
  mesh.scene = other.scene;
  mesh.topology = other.topology;
  Division division;
  division.parts = std::move(parts);
  add_patches(mesh, *mesh.scene, division);
  measure_patches(mesh);
  colour_patches(mesh, *mesh.scene);
  return mesh;
}

std::uint64_t PatchMesh::geometry_hash() const {
  Fingerprint hash;
  const auto add = [&](const Vector3& point) { hash.add(std::span<const double>(point.data(), 3)); };
  for (Index i = 0; i < patch_count(); ++i) {
    const int corner_count = patches[static_cast<std::size_t>(i)].corner_count;
    hash.add(static_cast<std::uint64_t>(corner_count));
    for (int k = 0; k < corner_count; ++k) add(corner(i, k));
  }
  hash.add(static_cast<std::uint64_t>(scene->faces.size()));
  for (const Face& face : scene->faces)
    for (int k = 0; k < face.corner_count; ++k) add(radiosity::corner(*scene, face, k));
  return hash.value();
}

}  // namespace radiosity

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

using Vector3 = Eigen::Vector3d;
using Color = Eigen::Array3d;

/// A Lambertian surface.
struct Material {
  std::string name;
  Color reflectance = Color::Constant(0.5);  ///< rho, 0 <= rho <= 1, linear RGB
  Color emission = Color::Zero();            ///< radiant exitance, W/m^2 (imported radiance times pi)
};

/// A triangle or a planar convex quad; its front is the side from which its corners run counter-clockwise.
struct Face {
  std::array<int, 4> corners{};  ///< indices into Scene::vertices; the last is unused in a triangle
  int corner_count = 3;          ///< 3 or 4
  int material = 0;              ///< index into Scene::materials
  int group = 0;                 ///< index into Scene::groups
};

/// A pinhole camera looking from `position` at `target`.
struct Camera {
  Vector3 position = Vector3::Zero();
  Vector3 target = Vector3::UnitZ();
  Vector3 up = Vector3::UnitY();
  double vertical_field_of_view = 39.3077;  ///< degrees
};

/// Where a face reaches under what stands on it (a floor under a block), the covered part is no surface
/// (scene/contacts.hpp). Whether patches and topology leave it out:
enum class Contacts {
  when_subdivided,  ///< only where faces are cut into patches anyway; else each input face stays one patch
  always,           ///< the scene's description counts on it
  never             ///< every face is taken as it is
};

/// What a file or a built-in name describes: coarse faces with materials and groups, before any subdivision.
struct Scene {
  std::string name;
  std::vector<Vector3> vertices;  ///< metres (or the file's own unit), double
  std::vector<Face> faces;
  std::vector<Material> materials;
  std::vector<std::string> groups;  ///< of the OBJ `g`, else `o`, else the material; equal names are merged
  std::optional<Camera> camera;
  std::vector<std::string> notes;  ///< what the importer changed or dropped, one sentence each
  bool box_like = false;           ///< every face a rectangle to be cut into m x m quads (cube)
  bool conforming = false;         ///< quads share whole edges, which a wanted number of patches cuts alike
  Contacts contacts = Contacts::when_subdivided;
};

/// Corner `k` (0 <= k < corner_count) of a face.
inline const Vector3& corner(const Scene& scene, const Face& face, int k) {
  return scene.vertices[static_cast<std::size_t>(face.corners[static_cast<std::size_t>(k)])];
}

/// Area vector of a face: its length is the area, its direction the front normal.
Vector3 area_vector(const Scene& scene, const Face& face);

/// Length of the diagonal of the bounding box of all vertices; 0 without vertices.
double diagonal(const Scene& scene);

/// Every triangle or quad with its front and its back: adds a reversed twin to each face (option
/// --two-sided). Contacts are cut first where the scene says so, for a twin would hide them.
Scene two_sided(const Scene& scene);

/// How the surface is connected.
struct Topology {
  bool closed = false;     ///< the oriented faces have no boundary (T-junctions are allowed)
  double volume = 0;       ///< signed; negative where the fronts look into an enclosed space
  bool enclosure = false;  ///< closed and looking inwards: light cannot leave, rows of F can sum to 1
  bool convex = false;     ///< every vertex on or in front of every face: nothing can block a ray
};

/// Determines how a scene is connected. Edges cancel as oriented intervals on their carrier lines, so that a
/// face edge may be met by several shorter ones.
Topology topology(const Scene& scene);

}  // namespace radiosity

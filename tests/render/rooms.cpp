#include "rooms.hpp"

#include <map>

namespace radiosity::test {
namespace {

int add_material(Scene& scene, const std::string& name, double emission, double reflectance) {
  Material material;
  material.name = name;
  material.reflectance = Color::Constant(reflectance);
  material.emission = Color::Constant(emission);
  scene.materials.push_back(material);
  scene.groups.push_back(name);
  return static_cast<int>(scene.materials.size()) - 1;
}

}  // namespace

Scene box_room(const Vector3& size) {
  Scene scene;
  scene.name = "box-room";
  for (int corner = 0; corner < 8; ++corner)
    scene.vertices.push_back(
        size.cwiseProduct(Vector3((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0).cast<double>()));
  const std::array<std::array<int, 4>, 6> walls = {
      {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}}};
  const std::array<const char*, 6> names = {"left", "right", "floor", "ceiling", "back", "front"};
  for (std::size_t wall = 0; wall < walls.size(); ++wall) {
    const int material = add_material(scene, names[wall], 0, 0.5);
    scene.faces.push_back({walls[wall], 4, material, material});
  }
  return scene;
}

Scene sphere_room(int level) {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  Scene scene;
  scene.name = "sphere-room";
  const int material = add_material(scene, "sphere", 0, 0.5);
  for (const double s : {-1.0, 1.0})
    for (const double t : {-golden, golden}) {
      scene.vertices.emplace_back(s, t, 0);
      scene.vertices.emplace_back(0, s, t);
      scene.vertices.emplace_back(t, 0, s);
    }
  for (Vector3& vertex : scene.vertices) vertex.normalize();

  // Faces of the icosahedron: all triples of vertices that are one edge length apart.
  std::vector<std::array<int, 3>> triangles;
  const double edge = 2 / std::sqrt(1 + golden * golden);
  const auto adjacent = [&](int a, int b) {
    return std::abs(
               (scene.vertices[static_cast<std::size_t>(a)] - scene.vertices[static_cast<std::size_t>(b)])
                   .norm() -
               edge) < 1e-9;
  };
  for (int a = 0; a < 12; ++a)
    for (int b = a + 1; b < 12; ++b)
      for (int c = b + 1; c < 12; ++c)
        if (adjacent(a, b) && adjacent(b, c) && adjacent(a, c)) triangles.push_back({a, b, c});

  for (int k = 0; k < level; ++k) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [at, fresh] =
          middles.try_emplace(std::minmax(a, b), static_cast<int>(scene.vertices.size()));
      if (fresh)
        scene.vertices.push_back(
            (scene.vertices[static_cast<std::size_t>(a)] + scene.vertices[static_cast<std::size_t>(b)])
                .normalized());
      return at->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : triangles) {
      const int ab = middle(a, b);
      const int bc = middle(b, c);
      const int ca = middle(c, a);
      for (const auto& triangle : {std::array{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}})
        finer.push_back(triangle);
    }
    triangles = finer;
  }
  for (auto [a, b, c] : triangles) {
    const Vector3& p = scene.vertices[static_cast<std::size_t>(a)];
    const Vector3& q = scene.vertices[static_cast<std::size_t>(b)];
    const Vector3& r = scene.vertices[static_cast<std::size_t>(c)];
    if ((q - p).cross(r - p).dot(p) > 0) std::swap(b, c);  // front towards the centre
    scene.faces.push_back({{a, b, c, 0}, 3, material, material});
  }
  return scene;
}

void add_square(Scene& scene, double z, bool front_up, double emission, double reflectance) {
  const int material =
      add_material(scene, "square-" + std::to_string(scene.groups.size()), emission, reflectance);
  const auto first = static_cast<int>(scene.vertices.size());
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) scene.vertices.emplace_back(x, y, z);
  Face face{{first, first + 1, first + 2, first + 3}, 4, material, material};
  if (!front_up) std::swap(face.corners[1], face.corners[3]);
  scene.faces.push_back(face);
}

void make_furnace(PatchMesh& mesh, double reflectance, double emission) {
  mesh.reflectance = Eigen::MatrixXd::Constant(mesh.patch_count(), 1, reflectance);
  mesh.emission = Eigen::MatrixXd::Constant(mesh.patch_count(), 1, emission);
}

double group_mean(const PatchMesh& mesh, int group, const Eigen::MatrixXd& field) {
  double sum = 0;
  double area = 0;
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    if (mesh.patches[static_cast<std::size_t>(i)].group != group) continue;
    sum += mesh.area[i] * field(i, 0);
    area += mesh.area[i];
  }
  return sum / area;
}

}  // namespace radiosity::test

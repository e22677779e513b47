#include "form_factors/exact_rooms.hpp"

#include "foundation/random.hpp"

#include <cmath>
#include <memory>
#include <numbers>

namespace radiosity::exact_rooms {

namespace {

Eigen::VectorXd random_areas(Index n, RandomStream& random) {
  Eigen::VectorXd areas(n);
  for (double& area : areas) area = random.uniform(0.2, 3);
  return areas;
}

/// A symmetric matrix of random numbers of which a third are zero; its diagonal is zero.
Eigen::MatrixXd random_visibility(Index n, RandomStream& random) {
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < i; ++j)
      if (random.uniform() > 1.0 / 3) weights(i, j) = weights(j, i) = random.uniform();
  return weights;
}

/// Symmetric Sinkhorn; K A^{1/2} = A^{1/2} says that rows of F sum to 1.
void close_rows(Room& room) {
  const Eigen::VectorXd root = room.root_area();
  for (int sweep = 0; sweep < 200; ++sweep) {
    const Eigen::VectorXd scale = root.cwiseQuotient(room.kernel * root).cwiseSqrt();
    room.kernel = (scale.asDiagonal() * room.kernel * scale.asDiagonal()).eval();
    room.kernel = (0.5 * (room.kernel + room.kernel.transpose())).eval();
  }
}

}  // namespace

Eigen::MatrixXd Room::transport(Index channel) const {
  return reflectance.col(channel).asDiagonal() *
         (root_area().cwiseInverse().asDiagonal() * kernel * root_area().asDiagonal());
}

Room sphere_cavity(Index n, std::uint64_t seed, double reflectance) {
  RandomStream random(seed);
  Room room;
  room.area = random_areas(n, random);
  room.reflectance = Eigen::MatrixXd::Constant(n, 1, reflectance);
  room.kernel = room.root_area() * room.root_area().transpose() / room.area.sum();
  return room;
}

Room spherical_bowl(Index n, std::uint64_t seed, double beta_degrees, double reflectance) {
  Room room = sphere_cavity(n, seed, reflectance);
  room.kernel *= (1 - std::cos(beta_degrees * std::numbers::pi / 180)) / 2;
  return room;
}

Room closed_room(Index n, std::uint64_t seed, double reflectance) {
  RandomStream random(seed);
  Room room;
  room.area = random_areas(n, random);
  room.reflectance = Eigen::MatrixXd::Constant(n, 1, reflectance);
  room.kernel = random_visibility(n, random);
  close_rows(room);
  return room;
}

Room chained_rooms(int count, Index n, double door, std::uint64_t seed, double reflectance) {
  RandomStream random(seed);
  Room chain;
  chain.area = random_areas(count * n, random);
  chain.reflectance = Eigen::MatrixXd::Constant(count * n, 1, reflectance);
  chain.kernel = random_visibility(count * n, random);
  for (Index i = 0; i < count * n; ++i)
    for (Index j = 0; j < count * n; ++j)
      if (i / n != j / n) chain.kernel(i, j) *= std::abs(i / n - j / n) == 1 ? door : 0;
  close_rows(chain);
  return chain;
}

Room open_room(Index n, std::uint64_t seed, Index channels) {
  RandomStream random(seed);
  Room room = closed_room(n, seed + 1000, 0);
  Eigen::VectorXd openness(n);
  for (Index i = 0; i < n; ++i) openness[i] = i % 17 == 3 ? 0 : random.uniform(0.5, 1);
  room.kernel = (openness.asDiagonal() * room.kernel * openness.asDiagonal()).eval();
  room.reflectance.resize(n, channels);
  for (Index c = 0; c < channels; ++c)
    for (Index i = 0; i < n; ++i) room.reflectance(i, c) = i % 5 == 2 ? 0 : random.uniform(0, 0.95);
  return room;
}

Eigen::MatrixXd random_lights(Index n, Index columns, std::uint64_t seed) {
  Eigen::MatrixXd lights(n, columns);
  for (Index j = 0; j < columns; ++j) {
    RandomStream random(seed, static_cast<std::uint64_t>(j));
    for (Index i = 0; i < n; ++i) lights(i, j) = random.uniform();
  }
  return lights;
}

FormFactors form_factors_of(const Room& room) {
  const Index n = room.size();
  auto mesh = std::make_shared<PatchMesh>();
  mesh->patches.resize(static_cast<std::size_t>(n));
  mesh->area = room.area;
  mesh->reflectance = room.reflectance;
  mesh->emission = Eigen::MatrixXd::Zero(n, room.reflectance.cols());
  mesh->normal = Eigen::Matrix3Xd::Zero(3, n);
  mesh->centroid = Eigen::Matrix3Xd::Zero(3, n);
  SymmetricTiles<double> kernel(n, [](Index, Index) { return true; });
  for (Index i = 0; i < n; ++i)
    for (Index j = i; j < n; ++j) kernel.set(i, j, room.kernel(i, j));
  FormFactors form_factors;
  form_factors.mesh = mesh;
  form_factors.kernel = std::make_shared<const SymmetricTiles<double>>(kernel.without_zero_tiles());
  form_factors.exposed = Eigen::VectorXd::Ones(n);
  return form_factors;
}

}  // namespace radiosity::exact_rooms

#pragma once

#include "form_factors/form_factors.hpp"

#include <Eigen/Core>

#include <cstdint>

/// Transport problems whose form factors are known exactly, for tests and hard cases.
namespace radiosity::exact_rooms {

/// A transport problem without a scene: areas, reflectances and the kernel K, small enough to be a full
/// matrix.
struct Room {
  Eigen::VectorXd area;         ///< n
  Eigen::MatrixXd reflectance;  ///< n x channels
  Eigen::MatrixXd kernel;       ///< n x n, symmetric

  Index size() const { return area.size(); }
  Eigen::VectorXd root_area() const { return area.cwiseSqrt(); }
  /// T of one channel: R A^{-1/2} K A^{1/2}.
  Eigen::MatrixXd transport(Index channel) const;
};

/// The inside of a sphere cut into n patches of random area: F_ij = A_j / sum A exactly (also of i to
/// itself).
Room sphere_cavity(Index n, std::uint64_t seed, double reflectance);

/// A bowl of half-angle beta < 180 degrees cut from a sphere, n patches of random area: F_ij = A_j / area of
/// the sphere, so that each row sums to f = (1 - cos beta) / 2.
Room spherical_bowl(Index n, std::uint64_t seed, double beta_degrees, double reflectance);

/// A closed room with random visibility: a random symmetric kernel scaled until every row of F sums to 1 to
/// rounding.
Room closed_room(Index n, std::uint64_t seed, double reflectance);

/// `count` closed rooms of n patches each in a row; each sends about the share `door` of its light to its
/// neighbours.
Room chained_rooms(int count, Index n, double door, std::uint64_t seed, double reflectance);

/// Row sums of F between 0 and 1, random reflectances in [0, 0.95], a fifth of the patches black, two patches
/// isolated.
Room open_room(Index n, std::uint64_t seed, Index channels);

/// Random fields in [0, 1).
Eigen::MatrixXd random_lights(Index n, Index columns, std::uint64_t seed);

/// Form factors whose mesh has areas and reflectances and no geometry, K in tiles (those that are
/// zero are not kept): what registered operators are built from.
FormFactors form_factors_of(const Room& room);

}  // namespace radiosity::exact_rooms

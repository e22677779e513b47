#pragma once

#include "form_factors/form_factors.hpp"
#include "operators/kernel_operator.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace radiosity::testing {

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

/// Form factors whose mesh has areas and reflectances and no geometry, K in tiles: what registered operators
/// are built from.
FormFactors form_factors_of(const Room& room);

/// The room as a symmetric operator, multiplied by the plainest loop there is.
class RoomKernel final : public KernelOperator {
 public:
  explicit RoomKernel(const Room& room) : KernelOperator(form_factors_of(room)), matrix_(room.kernel) {}
  ByteCount bytes() const override { return {}; }
  std::string describe() const override { return "room-kernel"; }

 private:
  void multiply_kernel(const ConstFieldRef& X, FieldRef Y) const override { Y = matrix_.lazyProduct(X); }
  Eigen::MatrixXd matrix_;
};

/// The room's T as an operator that nobody knows to be symmetric.
class RoomTransport final : public LinearOperator {
 public:
  explicit RoomTransport(const Room& room);
  Index size() const override { return matrices_.front().rows(); }
  Index channels() const override { return static_cast<Index>(matrices_.size()); }
  ByteCount bytes() const override { return {}; }
  std::string describe() const override { return "room-transport"; }

 private:
  void apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const override;
  std::vector<Eigen::MatrixXd> matrices_;
};

/// Specs of every registered solver at its defaults, and of gmres with short cycles.
std::vector<std::string> all_solvers();

}  // namespace radiosity::testing

#pragma once

#include "form_factors/exact_rooms.hpp"
#include "operators/kernel_operator.hpp"

#include <string>
#include <vector>

namespace radiosity::testing {

using namespace exact_rooms;

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

/// Specs of every registered solver that takes any operator at its defaults, and of gmres with short cycles.
std::vector<std::string> all_solvers();

}  // namespace radiosity::testing

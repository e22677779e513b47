#include "room_operators.hpp"

#include "solvers/solver_registry.hpp"

namespace radiosity::testing {

RoomTransport::RoomTransport(const Room& room) {
  for (Index c = 0; c < room.reflectance.cols(); ++c) matrices_.push_back(room.transport(c));
}

void RoomTransport::apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const {
  for (Index j = 0; j < X.cols(); ++j) {
    const Eigen::VectorXd image = matrices_[static_cast<std::size_t>(j % channels())] * X.col(j);
    if (beta == 0)
      Y.col(j) = alpha * image;
    else
      Y.col(j) = alpha * image + beta * Y.col(j);
  }
}

std::vector<std::string> all_solvers() {
  std::vector<std::string> specs{"gmres:restart=5"};
  const SolverRegistry solvers = cpu_solvers();
  for (const SolverEntry& entry : solvers.entries())
    if (entry.exact_operator == "dense") specs.push_back(entry.name);
  return specs;
}

}  // namespace radiosity::testing

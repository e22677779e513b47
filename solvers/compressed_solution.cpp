#include "solvers/compressed_solution.hpp"

#include "foundation/error.hpp"
#include "solvers/symmetric_kernel.hpp"

namespace radiosity {

namespace {

constexpr double inner_tolerance = 1e-3;
constexpr int most_inner_steps = 300;

/// Conjugate gradients for (I - S~) z = r from z = 0, one column, given the images (I - S~) p.
struct InnerSolution {
  Eigen::VectorXd z, r, p;
  double squared = 0;
  double wanted = 0;
  bool done = false;

  explicit InnerSolution(const Eigen::VectorXd& residual)
      : z(Eigen::VectorXd::Zero(residual.size())), r(residual), p(residual), squared(r.squaredNorm()) {
    wanted = inner_tolerance * inner_tolerance * squared;
    done = squared == 0;
  }

  void advance(const Eigen::VectorXd& image) {
    const double curvature = p.dot(image);
    if (!(curvature > 0)) {
      done = true;
      return;
    }
    const double length = squared / curvature;
    z += length * p;
    r -= length * image;
    const double next = r.squaredNorm();
    p = r + next / squared * p;
    squared = next;
    done = squared <= wanted;
  }
};

}  // namespace

CompressedSolution::CompressedSolution(const SolverProblem& problem, const std::string& spec) : spec_(spec) {
  if (!problem.make_operator)
    fail<UsageError>("cg:preconditioner={} needs form factors to build that operator from; use cg", spec);
  transport_ = problem.make_operator(spec);
  kernel_ = &require_symmetric_kernel("cg:preconditioner", *transport_);
}

Field CompressedSolution::operator()(const Field& residuals, const std::vector<Index>& channel,
                                     const Field& root_reflectance) const {
  std::vector<InnerSolution> inner;
  inner.reserve(static_cast<std::size_t>(residuals.cols()));
  for (Index c = 0; c < residuals.cols(); ++c) inner.emplace_back(residuals.col(c));
  for (int step = 0; step < most_inner_steps; ++step) {
    std::vector<std::size_t> open;
    for (std::size_t c = 0; c < inner.size(); ++c)
      if (!inner[c].done) open.push_back(c);
    if (open.empty()) break;
    Field inputs(residuals.rows(), static_cast<Index>(open.size()));
    Field outputs(residuals.rows(), inputs.cols());
    for (std::size_t k = 0; k < open.size(); ++k)
      inputs.col(static_cast<Index>(k)) =
          root_reflectance.col(channel[open[k]]).cwiseProduct(inner[open[k]].p);
    kernel_->apply_kernel(inputs, outputs);
    for (std::size_t k = 0; k < open.size(); ++k) {
      const auto root = root_reflectance.col(channel[open[k]]);
      inner[open[k]].advance(inner[open[k]].p - root.cwiseProduct(outputs.col(static_cast<Index>(k))));
    }
  }
  Field solutions(residuals.rows(), residuals.cols());
  for (Index c = 0; c < residuals.cols(); ++c) solutions.col(c) = inner[static_cast<std::size_t>(c)].z;
  return solutions;
}

}  // namespace radiosity

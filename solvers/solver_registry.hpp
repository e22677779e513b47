#pragma once

#include "foundation/spec.hpp"
#include "solvers/solver.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace radiosity {

/// What a solver is made for. The operator outlives the solver; `root_area` is A^{1/2}, n.
struct SolverProblem {
  const LinearOperator& transport;
  Eigen::VectorXd root_area;
  SolverOptions options;
  /// Builds another operator of the same form factors from a spec, for solvers that use one beside
  /// `transport`; empty where there is no such choice.
  std::function<std::unique_ptr<LinearOperator>(const std::string&)> make_operator = {};
};

struct SolverEntry {
  std::string name;
  std::string summary;
  std::string defaults;  ///< keys with their defaults, as a spec
  std::function<std::unique_ptr<Solver>(Spec&, const SolverProblem&)> make;
  /// An operator that keeps every entry of T to double precision and that this solver takes: what it is tried
  /// with.
  std::string exact_operator = "dense";
};

/// The solvers a program knows, as a value.
class SolverRegistry {
 public:
  SolverRegistry() = default;
  explicit SolverRegistry(std::vector<SolverEntry> entries);

  /// Throws UsageError if the name is taken.
  void add(SolverEntry entry);
  const std::vector<SolverEntry>& entries() const { return entries_; }

  /// SolverEntry::exact_operator of the solver that a spec names. Throws UsageError for unknown names.
  const std::string& exact_operator(const std::string& spec) const;

  /// Parses and builds; an empty spec means the operator's own answer where it is global, cg where it is
  /// symmetric, else gmres. Throws UsageError for unknown names and keys, and for a solver that the operator
  /// does not allow (cg on an unsymmetric one, any on a global one).
  std::unique_ptr<Solver> make(const std::string& spec, const SolverProblem& problem) const;

 private:
  const SolverEntry& entry(const std::string& name) const;

  std::vector<SolverEntry> entries_;
};

SolverRegistry cpu_solvers();

}  // namespace radiosity

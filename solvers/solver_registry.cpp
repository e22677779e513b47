#include "solvers/solver_registry.hpp"

#include "foundation/error.hpp"
#include "solvers/conjugate_gradients.hpp"
#include "solvers/direct_answer.hpp"
#include "solvers/gauss_seidel.hpp"
#include "solvers/gmres.hpp"
#include "solvers/lu.hpp"
#include "solvers/neumann.hpp"
#include "solvers/woodbury.hpp"

#include <algorithm>
#include <utility>

namespace radiosity {

namespace {

template <typename Kind>
std::unique_ptr<Solver> make_plain(Spec&, const SolverProblem& problem) {
  return std::make_unique<Kind>(problem);
}

std::unique_ptr<Solver> make_gmres(Spec& spec, const SolverProblem& problem) {
  return std::make_unique<Gmres>(problem, static_cast<int>(spec.integer("restart", 30, 1, 10000)));
}

std::unique_ptr<Solver> make_conjugate_gradients(Spec& spec, const SolverProblem& problem) {
  return std::make_unique<ConjugateGradients>(problem, spec.rest("preconditioner"));
}

}  // namespace

SolverRegistry::SolverRegistry(std::vector<SolverEntry> entries) {
  for (SolverEntry& entry : entries) add(std::move(entry));
}

void SolverRegistry::add(SolverEntry entry) {
  for (const SolverEntry& known : entries_)
    if (known.name == entry.name) fail<UsageError>("A solver named '{}' is registered already.", entry.name);
  entries_.push_back(std::move(entry));
}

const SolverEntry& SolverRegistry::entry(const std::string& name) const {
  std::string known;
  for (const SolverEntry& candidate : entries_) {
    if (candidate.name == name) return candidate;
    known += (known.empty() ? "" : ", ") + candidate.name;
  }
  fail<UsageError>("There is no solver '{}': the known ones are {}.", name, known);
}

const std::string& SolverRegistry::exact_operator(const std::string& spec) const {
  return entry(Spec::parse(spec).name()).exact_operator;
}

std::unique_ptr<Solver> SolverRegistry::make(const std::string& text, const SolverProblem& problem) const {
  if (text.empty() && problem.transport.global()) return std::make_unique<DirectAnswer>(problem.transport);
  Spec spec = Spec::parse(!text.empty() ? text : problem.transport.symmetric() ? "cg" : "gmres");
  const SolverEntry& chosen = entry(spec.name());
  require_transport(chosen.name, problem.transport);
  std::unique_ptr<Solver> solver = chosen.make(spec, problem);
  spec.finish();
  return solver;
}

SolverRegistry cpu_solvers() {
  return SolverRegistry({
      {"cg",
       "conjugate gradients on the symmetric form; the default for symmetric operators; "
       "preconditioner=OPERATOR, "
       "the last key, solves with that operator first and corrects",
       "cg", make_conjugate_gradients},
      {"gmres", "restarted GMRES; the default for other operators", "gmres:restart=30", make_gmres},
      {"neumann", "one bounce an iteration, where the spectral radius is known to be below 1", "neumann",
       make_plain<Neumann>},
      {"gauss-seidel", "sweeps over the patches (document 003); reads every entry", "gauss-seidel",
       make_plain<GaussSeidel>},
      {"lu", "direct: LU of every channel's matrix; reads every entry", "lu", make_plain<Lu>},
      {"woodbury", "direct: for operators of low rank (document 004)", "woodbury", make_plain<Woodbury>,
       "svd:k=1048576,norm=area,storage=f64,closure=none"},
  });
}

}  // namespace radiosity

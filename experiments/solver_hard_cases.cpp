#include "experiments/hard_case_scenes.hpp"
#include "experiments/hard_cases.hpp"
#include "foundation/error.hpp"
#include "operators/kernel_operator.hpp"
#include "solvers/error_certificate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace radiosity {
namespace {

using Verdict = HardCaseOutcome::Verdict;

constexpr double roundoff = 0x1p-53;

/// A solver with the true operator.
class Problem {
 public:
  Problem(const HardCaseSubject& subject, const FormFactors& form_factors, double tolerance)
      : form_factors_(form_factors),
        transport_(subject.operators.make(subject.solvers.exact_operator(subject.spec), form_factors)),
        root_area_(form_factors.mesh->area.cwiseSqrt()),
        solver_(subject.solvers.make(subject.spec, {*transport_,
                                                    root_area_,
                                                    {.tolerance = tolerance, .max_products = 3000},
                                                    [&subject, this](const std::string& spec) {
                                                      return subject.operators.make(spec, form_factors_);
                                                    }})) {}

  Solver& solver() { return *solver_; }
  const LinearOperator& transport() const { return *transport_; }
  Field norms(const Field& X) const { return area_norms(root_area_, X); }
  const Field& answer(const Field& emission) { return solve(*solver_, emission); }

  /// E - (I - T) B.
  Field residual(const Field& emission) const {
    const Field& B = solver_->radiosity();
    Field image(B.rows(), B.cols());
    transport_->apply(B, image);
    return emission - B + image;
  }
  /// ||E - (I - T) B|| / ||E||, largest over the columns, less what rounding may make it: 30 u ||B|| / ||E||.
  double relative_residual(const Field& emission) const {
    const Eigen::ArrayXXd rounding = 30 * roundoff * norms(solver_->radiosity()).array();
    return ((norms(residual(emission)).array() - rounding) / norms(emission).array()).maxCoeff();
  }

 private:
  FormFactors form_factors_;
  std::unique_ptr<LinearOperator> transport_;
  Eigen::VectorXd root_area_;
  std::unique_ptr<Solver> solver_;
};

/// G8: with F = 0, B = E but for its scaling by A^{1/2}.
HardCaseOutcome nothing_to_reflect(const HardCaseSubject& subject) {
  for (const Index n : {1, 2, 3, 5, 17, 33}) {
    Problem problem(subject, traced_scene("flat", n), 1e-8);
    const Field emission = exact_rooms::random_lights(n, problem.transport().channels(), 31);
    const Field error = (problem.answer(emission) - emission).cwiseAbs();
    if (!(error.array() <= 4 * roundoff * emission.array()).all())
      return HardCaseOutcome::of_failure(fmt::format("F = 0 with {} patches: B is not E", n));
  }
  Problem empty(subject, form_factors_of(exact_rooms::Room{{}, Eigen::MatrixXd(0, 1), Eigen::MatrixXd(0, 0)}),
                1e-8);
  if (empty.answer(Field(0, 1)).rows() != 0)
    return HardCaseOutcome::of_failure("no patches, and yet an answer");
  return {};
}

std::string sentence_of(const std::set<std::string>& sentences) {
  return sentences.empty() ? std::string() : *sentences.begin();
}

/// R1: 1 - rho from 1e-1 to 1e-12 in a closed room, as far as double precision goes; rho = 1 is singular.
HardCaseOutcome nearly_singular(const HardCaseSubject& subject) {
  constexpr double allowed = 30;
  double worst = 0;
  double refused_from = 0;
  std::set<std::string> refusals;
  for (const double distance : {1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    const FormFactors room = form_factors_of(exact_rooms::closed_room(96, 3, 1 - distance));
    Field emission = exact_rooms::random_lights(96, 2, 8);
    emission.col(1) = Eigen::VectorXd::Unit(96, 4);
    // A stationary iteration is asked for the default tolerance, and may say that its budget does not
    // suffice.
    bool answered = true;
    try {
      Problem usual(subject, room, 1e-6);
      usual.answer(emission);
      const double residual = usual.relative_residual(emission);
      if (!(residual <= 1.001e-6))
        return HardCaseOutcome::of_failure(
            fmt::format("1 - rho = {:.0e}: ended at a residual of {:.1e}, not 1e-6", distance, residual));
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      answered = false;
      refusals.insert(error.what());
      refused_from = std::max(refused_from, distance);
    }
    if (!answered) continue;
    Problem problem(subject, room, 1e-17);
    try {
      problem.answer(emission);
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      if (std::string(error.what()).find("double precision") == std::string::npos) continue;
    }
    // ||I - T|| >= 1 is taken as 1, which is the strict side.
    const Eigen::ArrayXXd backward = problem.norms(problem.residual(emission)).array() /
                                     problem.norms(problem.solver().radiosity()).array();
    worst = std::max(worst, backward.maxCoeff() / roundoff / allowed);
  }
  try {
    Problem singular(subject, form_factors_of(exact_rooms::closed_room(96, 3, 1)), 1e-6);
    singular.answer(Field::Ones(96, 1));
    return HardCaseOutcome::of_failure("rho = 1 in a closed room was answered");
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    if (std::string(error.what()).find("singular") == std::string::npos)
      return HardCaseOutcome::of_failure(
          fmt::format("rho = 1 was refused for another reason: {}", error.what()));
  }
  std::string note;
  if (!refusals.empty())
    note = fmt::format("refuses from 1 - rho = {:.0e} on: {}", refused_from, sentence_of(refusals));
  return HardCaseOutcome::of_ratio(worst, note);
}

/// R3: areas from 1e-6 to 1e6 and reflectances from 0.01 to 0.999: the certificate of the answer holds.
HardCaseOutcome uneven_areas(const HardCaseSubject& subject) {
  const FormFactors scene = traced_scene("uneven-areas", 300);
  const Field emission = exact_rooms::random_lights(scene.patch_count(), scene.mesh->channels(), 41);
  const auto truth = subject.operators.make("dense", scene);
  const Eigen::VectorXd root_area = scene.mesh->area.cwiseSqrt();
  const auto reference = subject.solvers.make("lu", {*truth, root_area, {}});
  const Field exact = solve(*reference, emission);
  Problem problem(subject, scene, 1e-6);
  const Field answer = problem.answer(emission);
  const ErrorCertificate certificate(dynamic_cast<const KernelOperator&>(*truth));
  const Eigen::RowVectorXd bound = certificate.bound(emission, answer).absolute;
  return HardCaseOutcome::of_ratio(area_norms(root_area, exact - answer).cwiseQuotient(bound).maxCoeff());
}

/// R4: ||error|| (1 - ||T||) / ||residual||, with ||T|| = rho in a closed room of one reflectance.
HardCaseOutcome stopping(const HardCaseSubject& subject) {
  double worst = 0;
  for (const double reflectance : {0.5, 0.9, 0.99}) {
    const FormFactors room = form_factors_of(exact_rooms::closed_room(90, 27, reflectance));
    const Field emission = exact_rooms::random_lights(90, 2, 28);
    const auto truth = subject.operators.make("dense", room);
    const auto reference =
        subject.solvers.make("lu", {*truth, room.mesh->area.cwiseSqrt(), {.tolerance = 1e-11}});
    const Field exact = solve(*reference, emission);
    Problem problem(subject, room, 1e-4);
    const Field answer = problem.answer(emission);
    const Eigen::ArrayXXd residual = problem.norms(problem.residual(emission)).array();
    const Eigen::ArrayXXd rounding = 100 * roundoff / (1 - reflectance) * problem.norms(exact).array();
    const Eigen::ArrayXXd error = problem.norms(exact - answer).array() - rounding;
    worst = std::max(worst, ((1 - reflectance) * error / (residual + roundoff)).maxCoeff());
    if (!(problem.relative_residual(emission) <= 1.001e-4))
      return HardCaseOutcome::of_failure("it ended before its tolerance was met");
  }
  return HardCaseOutcome::of_ratio(std::max(worst, 0.0));
}

/// E1 and E2 at a tight tolerance: error over tolerance / (1 - rho).
HardCaseOutcome known_solutions(const HardCaseSubject& subject,
                                const std::function<KnownSolution(Index, double)>& problem_at) {
  constexpr double tolerance = 1e-9;
  double worst = 0;
  for (const double reflectance : {0.5, 0.9, 0.99}) {
    const KnownSolution known = problem_at(80, reflectance);
    Problem problem(subject, known.form_factors, tolerance);
    const Field answer = problem.answer(known.emission);
    const double error = problem.norms(known.radiosity - answer)(0, 0) / problem.norms(known.emission)(0, 0);
    worst = std::max(worst, error * (1 - reflectance) / tolerance);
  }
  return HardCaseOutcome::of_ratio(worst, {}, 1e-3);
}

HardCaseOutcome solved_furnaces(const HardCaseSubject& subject) {
  return known_solutions(subject, furnace);
}

HardCaseOutcome solved_spheres(const HardCaseSubject& subject) {
  const HardCaseOutcome sphere = known_solutions(subject, lit_sphere);
  const HardCaseOutcome bowl = known_solutions(subject, lit_bowl);
  return bowl.ratio.value_or(0) > sphere.ratio.value_or(0) ? bowl : sphere;
}

/// S1: products and true residuals.
HardCaseOutcome solved_chains(const HardCaseSubject& subject) {
  double worst = 0;
  std::string note = "products";
  std::set<std::string> refusals;
  for (const int rooms : {2, 5, 10})
    for (const double reflectance : {0.99, 0.9999}) {
      const FormFactors chain =
          traced_scene(fmt::format("rooms:n={},door=0.3", rooms), 60 * rooms, reflectance);
      Problem problem(subject, chain, 1e-6);
      try {
        problem.answer(chain.mesh->emission);
        worst = std::max(worst, problem.relative_residual(chain.mesh->emission) / 1e-6);
        note += fmt::format(" {}", problem.solver().products());
      } catch (const Cancelled&) {
        throw;
      } catch (const Error& error) {
        refusals.insert(error.what());
        note += " -";
      }
    }
  if (!refusals.empty()) note += fmt::format("; -: {}", sentence_of(refusals));
  return HardCaseOutcome::of_ratio(worst, note, 1e-3);
}

}  // namespace

std::vector<HardCase> solver_hard_cases() {
  return {
      {"G8", "F = 0 and no patches at all: B = E to 4 u", nothing_to_reflect},
      {"R1", "1 - rho from 1e-1 to 1e-12: backward error over 30 u; rho = 1 is said to be singular",
       nearly_singular},
      {"R3", "areas 1e-6 to 1e6, reflectances 0.01 to 0.999: error over its certificate", uneven_areas},
      {"R4", "error times (1 - ||T||) over the residual that it stopped at", stopping},
      {"E1", "furnace, B = E / (1 - rho): error over tolerance / (1 - rho)", solved_furnaces},
      {"E2", "inside of a sphere and of a bowl: error over tolerance / (1 - rho)", solved_spheres},
      {"S1", "chains of 2, 5, 10 rooms at 0.99 and 0.9999: residual over tolerance", solved_chains},
  };
}

}  // namespace radiosity

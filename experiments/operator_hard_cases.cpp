#include "experiments/hard_case_scenes.hpp"
#include "experiments/hard_cases.hpp"
#include "foundation/error.hpp"
#include "operators/kernel_operator.hpp"
#include "operators/operator_checks.hpp"
#include "solvers/error_certificate.hpp"
#include "solvers/spectral_radius.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiosity {
namespace {

using Verdict = HardCaseOutcome::Verdict;

std::unique_ptr<LinearOperator> make(const HardCaseSubject& subject, const FormFactors& form_factors,
                                     const std::string& more_keys = {}) {
  return subject.operators.make(more_keys.empty() ? subject.spec : with_keys(subject.spec, more_keys),
                                form_factors);
}

Field image_of(const LinearOperator& transport, const Field& X) {
  Field Y(X.rows(), X.cols());
  transport.apply(X, Y);
  return Y;
}

/// F~ 1 for a scene in one reflectance.
Eigen::VectorXd row_sums(const LinearOperator& transport, const FormFactors& form_factors) {
  return image_of(transport, Field::Ones(transport.size(), transport.channels())).col(0) /
         form_factors.mesh->reflectance(0, 0);
}

/// ||B - B~|| / bound for the operator's answer, its own or by the solver that is its default, the bound from
/// the true kernel.
double error_over_bound(const HardCaseSubject& subject, const FormFactors& form_factors,
                        const Field& emission, const Field& truth, int* products = nullptr) {
  const auto transport = make(subject, form_factors);
  const auto true_kernel = subject.operators.make("dense", form_factors);
  const Eigen::VectorXd root_area = form_factors.mesh->area.cwiseSqrt();
  const auto solver = subject.solvers.make("", {*transport, root_area, {.tolerance = 1e-10}});
  const Field answer = solve(*solver, emission);
  if (products != nullptr) *products = solver->products();
  const ErrorCertificate certificate(dynamic_cast<const KernelOperator&>(*true_kernel));
  const Eigen::RowVectorXd bound = certificate.bound(emission, answer).absolute;
  const Eigen::RowVectorXd error = area_norms(root_area, truth - answer);
  double worst = 0;
  for (Index j = 0; j < error.size(); ++j)
    if (error[j] > 0) worst = std::max(worst, error[j] / bound[j]);
  return worst;
}

HardCaseOutcome known_solutions(const HardCaseSubject& subject, const std::vector<KnownSolution>& problems) {
  double worst = 0;
  for (const KnownSolution& problem : problems)
    worst =
        std::max(worst, error_over_bound(subject, problem.form_factors, problem.emission, problem.radiosity));
  return HardCaseOutcome::of_ratio(worst);
}

/// What arrives where nothing should, relative to what arrives at all: exactly 0, or, for an operator that
/// does not keep entries apart, within its own certificate; reported where it has none.
HardCaseOutcome unwanted_light(const LinearOperator& transport, double largest) {
  if (largest == 0) return {};
  const Certificate certificate = transport.certificate();
  if (!certificate.operator_error) return {Verdict::reported, largest, {}};
  return HardCaseOutcome::of_ratio(largest / *certificate.operator_error, "not exactly 0");
}

/// ||rows of `image` for which `dark` holds|| / ||image||.
template <typename Dark>
double share_in(const Field& image, const Dark& dark) {
  double square = 0;
  for (Index i = 0; i < image.rows(); ++i)
    if (dark(i)) square += image.row(i).squaredNorm();
  return square == 0 ? 0 : std::sqrt(square) / image.norm();
}

/// G7: nothing at all passes a wall.
HardCaseOutcome disconnected_rooms(const HardCaseSubject& subject) {
  HardCaseOutcome worst;
  for (const FormFactors& rooms :
       {traced_scene("disconnected-rooms:n=2", 120), traced_scene("rooms:n=2,door=0.3,closed=1", 120)}) {
    const auto transport = make(subject, rooms);
    Field light = Field::Zero(rooms.patch_count(), transport->channels());
    const double wall =
        0.5 * (rooms.mesh->centroid.row(0).minCoeff() + rooms.mesh->centroid.row(0).maxCoeff());
    for (Index i = 0; i < light.rows(); ++i)
      if (rooms.mesh->centroid(0, i) < wall) light.row(i).setOnes();
    const double passed = share_in(image_of(*transport, light), [&](Index i) { return light(i, 0) == 0; });
    const HardCaseOutcome outcome = unwanted_light(*transport, passed);
    if (outcome.ratio.value_or(0) > worst.ratio.value_or(0)) worst = outcome;
  }
  return worst;
}

/// G8.
HardCaseOutcome exact_zeros(const HardCaseSubject& subject) {
  std::vector<FormFactors> scenes = {traced_scene("isolated-patch", 60), traced_scene("open-box", 60)};
  for (const Index n : {1, 2, 3, 5, 17, 33}) scenes.push_back(traced_scene("flat", n));
  HardCaseOutcome worst;
  for (const FormFactors& scene : scenes) {
    const auto transport = make(subject, scene);
    const std::string failure = check_exact_zeros(*transport, own_entries(*transport));
    if (!failure.empty()) return HardCaseOutcome::of_failure(failure);
    const Eigen::VectorXd rows = scene.row_sums();
    const Field ones = Field::Ones(transport->size(), transport->channels());
    Field reflected = image_of(*transport, ones);
    if (transport->global()) reflected -= ones;
    const HardCaseOutcome outcome =
        unwanted_light(*transport, share_in(reflected, [&](Index i) { return rows[i] == 0; }));
    if (outcome.ratio.value_or(0) > worst.ratio.value_or(0)) worst = outcome;
  }
  return worst;
}

HardCaseOutcome products(const HardCaseSubject& subject) {
  double worst = 0;
  for (const FormFactors& scene :
       {traced_scene("cornell-box-closed", 150), form_factors_of(exact_rooms::open_room(65, 4, 3))}) {
    const auto transport = make(subject, scene);
    worst = std::max(worst, product_error_ratio(*transport, own_entries(*transport)));
  }
  return HardCaseOutcome::of_ratio(worst);
}

HardCaseOutcome scaling(const HardCaseSubject& subject) {
  const auto transport = make(subject, form_factors_of(exact_rooms::open_room(65, 4, 3)));
  const std::string failure = check_scaling(*transport);
  return HardCaseOutcome::of_failure(failure.empty() ? check_refusals(*transport) : failure);
}

HardCaseOutcome repeatability(const HardCaseSubject& subject) {
  return HardCaseOutcome::of_failure(
      check_repeatability(*make(subject, traced_scene("cornell-box-closed", 300))));
}

/// O4.
HardCaseOutcome certificates(const HardCaseSubject& subject) {
  double worst = 0;
  bool known = false;
  for (const FormFactors& scene :
       {traced_scene("cornell-box-closed", 150), traced_scene("rooms:n=2,door=0.3", 120, 0.99),
        form_factors_of(exact_rooms::open_room(65, 4, 3))}) {
    const CertificateRatio ratio =
        certificate_ratio(*make(subject, scene), exact_entries(scene), scene.mesh->area.cwiseSqrt());
    known = known || ratio.operator_error;
    worst = std::max({worst, ratio.operator_error.value_or(0) / 1.02, ratio.spectral_radius.value_or(0)});
  }
  if (!known) return {Verdict::reported, 0, "certifies nothing"};
  return HardCaseOutcome::of_ratio(worst);
}

/// What is missing or too much in the energy balance of an operator that maps E to B, for E = 1 on all
/// patches and relative to it: B - E is what arrives at patches times their reflectance.
double imbalance(const LinearOperator& global, const FormFactors& form_factors) {
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(global.size());
  const Eigen::VectorXd B = image_of(global, ones.replicate(1, global.channels())).col(0);
  const Eigen::VectorXd arriving =
      form_factors.row_sums().cwiseProduct(B);  // A_j sum_i F_ji = sum_i A_i F_ij
  const Eigen::VectorXd& area = form_factors.mesh->area;
  return std::fabs(area.dot(B - ones - form_factors.mesh->reflectance(0, 0) * arriving)) / area.sum();
}

/// O5: row sums to 1e-6 where entries or a closure give them; else what they are off by. Of an operator that
/// maps E to B, the energy balance of its answers.
HardCaseOutcome energy(const HardCaseSubject& subject) {
  constexpr double allowed = 1e-6;
  double worst = 0;
  bool closed = false;
  for (const FormFactors& scene :
       {traced_scene("cube", 96, 0.8), traced_scene("cornell-box-closed", 300, 0.8),
        traced_scene("rooms:n=2,door=0.3", 120, 0.8)}) {
    const auto transport = make(subject, scene);
    closed = closed || transport->describe().find("closure=") != std::string::npos;
    worst = std::max(worst, transport->global()
                                ? imbalance(*transport, scene)
                                : (row_sums(*transport, scene) - scene.row_sums()).cwiseAbs().maxCoeff());
  }
  if (worst > allowed && !closed) return {Verdict::reported, worst, {}};
  return HardCaseOutcome::of_ratio(worst / allowed);
}

/// R2: a bound on the spectral radius that holds, and Neumann's iteration only where it is below 1: never
/// with an operator that maps E to B.
HardCaseOutcome spectral_radius(const HardCaseSubject& subject) {
  const FormFactors room = traced_scene("cube", 96, 0.999);
  const auto transport = make(subject, room);
  if (transport->global()) {
    const auto taken = subject.solvers.make("neumann", {*transport, room.mesh->area.cwiseSqrt(), {}});
    return HardCaseOutcome::of_failure(taken->describe() + " took an operator that is not T");
  }
  const SpectralRadius bound = bound_spectral_radius(*transport);
  Field x = Field::Ones(transport->size(), transport->channels());
  double growth = 0;
  for (int step = 0; step < 200 && x.norm() > 0; ++step) {
    const Field y = image_of(*transport, x);
    growth = area_norms(room.mesh->area.cwiseSqrt(), y)[0] / area_norms(room.mesh->area.cwiseSqrt(), x)[0];
    x = y / y.norm();
  }
  if (!bound.upper) return {Verdict::refused, std::nullopt, "no bound is known"};
  HardCaseOutcome outcome = HardCaseOutcome::of_ratio(growth / *bound.upper, {}, 1e-9);
  if (outcome.verdict != Verdict::passed) return outcome;
  const Field emission = Field::Ones(transport->size(), transport->channels());
  const auto neumann = subject.solvers.make(
      "neumann", {*transport, room.mesh->area.cwiseSqrt(), {.tolerance = 1e-3, .max_products = 20000}});
  const Field answer = solve(*neumann, emission);  // or it refuses
  Field image = image_of(*transport, answer);
  const double residual = (emission + image - answer).norm() / emission.norm();
  if (!(residual <= 1.1e-3))
    return HardCaseOutcome::of_failure(fmt::format("Neumann ended at a residual of {:.1e}", residual));
  return outcome;
}

HardCaseOutcome furnaces(const HardCaseSubject& subject) {
  return known_solutions(subject, {furnace(80, 0.5), furnace(80, 0.9), furnace(80, 0.99)});
}

HardCaseOutcome spheres(const HardCaseSubject& subject) {
  return known_solutions(subject,
                         {lit_sphere(80, 0.5), lit_sphere(80, 0.99), lit_bowl(80, 0.5), lit_bowl(80, 0.99)});
}

/// S1.
HardCaseOutcome chains(const HardCaseSubject& subject) {
  double worst = 0;
  std::string note = "products";
  for (const int rooms : {2, 5, 10})
    for (const double reflectance : {0.99, 0.9999}) {
      const FormFactors chain =
          traced_scene(fmt::format("rooms:n={},door=0.3", rooms), 60 * rooms, reflectance);
      const auto truth = subject.operators.make("dense", chain);
      const Field& emission = chain.mesh->emission;
      const auto reference =
          subject.solvers.make("lu", {*truth, chain.mesh->area.cwiseSqrt(), {.tolerance = 1e-11}});
      int count = 0;
      worst =
          std::max(worst, error_over_bound(subject, chain, emission, solve(*reference, emission), &count));
      note += fmt::format(" {}", count);
    }
  return HardCaseOutcome::of_ratio(worst, note, 1e-3);
}

/// K1: symmetric scaling that does not exist is said not to, and adds no energy.
HardCaseOutcome impossible_closure(const HardCaseSubject& subject) {
  std::string remark;
  for (const FormFactors& scene :
       {traced_scene("facing-plates", 40, 0.9), traced_scene("isolated-patch", 60, 0.9)}) {
    const auto transport = make(subject, scene, "closure=symmetric");
    const Eigen::VectorXd excess = row_sums(*transport, scene) - scene.row_sums();
    if (excess.maxCoeff() > 1e-6)
      return HardCaseOutcome::of_failure(
          fmt::format("energy is added: a row sum is {:.1e} too large", excess.maxCoeff()));
    if (transport->remark().empty() && excess.minCoeff() < -1e-6)
      return HardCaseOutcome::of_failure(
          fmt::format("a row sum is {:.1e} too small, and nothing is said of it", -excess.minCoeff()));
    if (!transport->remark().empty()) remark = transport->remark();
  }
  return {Verdict::passed, std::nullopt, remark};
}

}  // namespace

std::vector<HardCase> operator_hard_cases() {
  return {
      {"G7", "no light through walls: exactly 0 in rooms that do not see each other", disconnected_rooms},
      {"G8", "open scenes, isolated patches, F = 0 and 1 to 33 patches: exactly 0 where it is", exact_zeros},
      {"O1", "products against the operator's own entries, in units of 2 n u |T| |X|", products},
      {"O2", "beta = 0 reads no Y, alpha = 0 no X, aliases and wrong shapes are refused", scaling},
      {"O3", "the same bits for 1, 2 and 8 threads and again", repeatability},
      {"O4", "error of products with random and adversarial fields over the operator's own certificate",
       certificates},
      {"O5", "error of row sums over 1e-6", energy},
      {"R2", "spectral radius over its bound at reflectance 0.999, and Neumann's iteration only below 1",
       spectral_radius},
      {"E1", "furnace, B = E / (1 - rho): error over its certificate", furnaces},
      {"E2", "inside of a sphere and of a bowl: error over its certificate", spheres},
      {"S1", "chains of 2, 5, 10 rooms at 0.99 and 0.9999: error over its certificate", chains},
      {"K1", "closure asked where it does not exist: said so, and no energy added", impossible_closure},
  };
}

}  // namespace radiosity

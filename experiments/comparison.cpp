#include "experiments/comparison.hpp"

#include "experiments/operator_measures.hpp"
#include "experiments/reference_solution.hpp"
#include "foundation/error.hpp"
#include "foundation/stopwatch.hpp"
#include "solvers/spectral_radius.hpp"

#include <algorithm>
#include <numeric>

namespace radiosity {

namespace {

constexpr int least_repetitions = 5;
constexpr int most_repetitions = 200;
constexpr double enough_seconds = 0.2;
constexpr int power_steps = 40;

/// What all operators of a comparison share.
struct Task {
  const FormFactors& form_factors;
  const OperatorRegistry& operators;
  const SolverRegistry& solvers;
  const ComparisonOptions& options;
  const LightSet& lights;
  const std::optional<Field>& reference;
  const Certifier* certifier;  ///< null where F has no symmetric kernel
  Monitor& monitor;

  const PatchMesh& mesh() const { return *form_factors.mesh; }
  Index light_count() const { return lights.emission.cols() / mesh().channels(); }
};

LightSet choose_lights(const PatchMesh& mesh, const ComparisonOptions& options, Monitor& monitor) {
  if (options.lights.total() > 0) return draw_lights(mesh, options.lights, options.seed, monitor);
  if (mesh.emission.isZero(0))
    fail<UsageError>(
        "The scene '{}' emits nothing and no lights were asked for: add --lights area:N,point:N,patch:N.",
        mesh.scene ? mesh.scene->name : std::string());
  return {{}, mesh.emission};
}

/// Runs `work` and puts the spec before the sentence of whatever it throws, of the same kind.
template <typename Work>
void with_spec(const std::string& spec, const Work& work) {
  const auto sentence = [&](const Error& error) {
    return fmt::format("Operator '{}': {}", spec, error.what());
  };
  try {
    work();
  } catch (const Cancelled&) {
    throw;
  } catch (const UsageError& error) {
    throw UsageError(sentence(error));
  } catch (const Error& error) {
    throw Error(sentence(error));
  }
}

Timing time_apply(const LinearOperator& transport, const Field& fields) {
  Field images(fields.rows(), fields.cols());
  transport.apply(fields, images);  // the first touches memory that later ones find in place
  std::vector<double> samples;
  const Stopwatch total;
  while (samples.size() < least_repetitions ||
         (samples.size() < most_repetitions && total.seconds() < enough_seconds)) {
    const Stopwatch stopwatch;
    transport.apply(fields, images);
    samples.push_back(stopwatch.seconds());
  }
  return Timing::of(std::move(samples));
}

double device_seconds(const LinearOperator& transport) {
  const std::optional<DeviceUse> use = transport.device_use();
  return use ? use->device_seconds : 0;
}

/// Fills apply and device_apply_seconds.
void time_products(const LinearOperator& transport, const Field& fields, ComparisonResult& result) {
  const double before = device_seconds(transport);
  const std::uint64_t products = transport.usage().products;
  result.apply = time_apply(transport, fields);
  result.device_apply_seconds =
      (device_seconds(transport) - before) / static_cast<double>(transport.usage().products - products);
}

/// Solves light by light, as whoever asks for one would; fills solver, solve and iterations and returns B of
/// all lights.
Field solve_lights(const Task& task, const LinearOperator& transport, ComparisonResult& result) {
  const Index channels = task.mesh().channels();
  const auto solver = task.solvers.make(
      task.options.solver,
      {transport, task.mesh().area.cwiseSqrt(), task.options.solver_options,
       [&](const std::string& spec) { return task.operators.make(spec, task.form_factors); }});
  result.solver = solver->describe();
  Field radiosity(task.lights.emission.rows(), task.lights.emission.cols());
  std::vector<double> samples;
  for (Index light = 0; light < task.light_count(); ++light) {
    task.monitor.checkpoint("solving " + result.spec,
                            static_cast<double>(light) / static_cast<double>(task.light_count()));
    const Field emission = task.lights.emission.middleCols(light * channels, channels);
    const Stopwatch stopwatch;
    radiosity.middleCols(light * channels, channels) = solve(*solver, emission);
    samples.push_back(stopwatch.seconds());
    result.iterations = std::max(result.iterations, solver->products());
  }
  result.solve = Timing::of(std::move(samples));
  return radiosity;
}

void summarize(const std::vector<double>& errors, std::optional<double>& mean, std::optional<double>& max) {
  if (errors.empty()) return;
  mean = std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
  max = *std::max_element(errors.begin(), errors.end());
}

void measure_errors(const Task& task, const LinearOperator& transport, const Field& radiosity,
                    ComparisonErrors& errors) {
  if (!transport.global() && task.form_factors.patch_count() <= task.options.largest_measured)
    errors.operator_frobenius = relative_frobenius_error(transport, task.form_factors, task.monitor);
  if (!task.reference) return;
  const Field& emission = task.lights.emission;
  summarize(relative_errors(task.mesh(), radiosity, *task.reference), errors.radiosity_mean,
            errors.radiosity_max);
  summarize(relative_errors(task.mesh(), Field(radiosity - emission), Field(*task.reference - emission)),
            errors.indirect_mean, errors.indirect_max);
}

/// What an operator that stands for T says of T.
void measure_transport(const Task& task, const LinearOperator& transport, ComparisonResult& result) {
  if (const auto range = row_sum_range(transport, task.form_factors)) {
    result.row_sum_min = range->first;
    result.row_sum_max = range->second;
  }
  result.spectral_radius = bound_spectral_radius(transport, power_steps).estimate;
}

ComparisonResult examine(const Task& task, const std::string& spec) {
  ComparisonResult result;
  result.spec = spec;
  task.monitor.checkpoint("building " + spec, 0);
  const Stopwatch build;
  const auto transport = task.operators.make(spec, task.form_factors);
  result.build_seconds = build.seconds();
  result.bytes = transport->bytes().total();
  time_products(*transport, task.lights.emission.leftCols(task.mesh().channels()), result);
  const Field radiosity = solve_lights(task, *transport, result);
  measure_errors(task, *transport, radiosity, result.errors);
  if (task.certifier != nullptr)
    result.certificate = task.certifier->certify(task.lights.emission, radiosity, task.reference);
  result.remark = transport->remark();
  result.device = transport->device_use();
  if (!transport->global()) measure_transport(task, *transport, result);
  return result;
}

}  // namespace

Timing Timing::of(std::vector<double> samples) {
  if (samples.empty()) fail<UsageError>("A timing needs at least one run.");
  std::sort(samples.begin(), samples.end());
  const std::size_t middle = samples.size() / 2;
  const bool even = samples.size() % 2 == 0;
  return {samples.front(), even ? 0.5 * (samples[middle - 1] + samples[middle]) : samples[middle]};
}

Comparison compare(const FormFactors& form_factors, const OperatorRegistry& operators,
                   const SolverRegistry& solvers, const ComparisonOptions& options, Monitor& monitor) {
  if (options.operators.empty()) fail<UsageError>("There is nothing to compare: name at least one operator.");
  Comparison comparison;
  comparison.form_factors = form_factors;
  comparison.lights = choose_lights(*form_factors.mesh, options, monitor);
  comparison.machine = options.machine ? *options.machine : measure_machine();
  monitor.checkpoint("reference solution", 0);
  const std::optional<Field> reference = reference_solution(form_factors, comparison.lights.emission);
  monitor.checkpoint("certificate", 0);
  const auto certifier = Certifier::make(form_factors, options.seed);
  const Task task{form_factors,      operators, solvers,         options,
                  comparison.lights, reference, certifier.get(), monitor};
  for (const std::string& spec : options.operators)
    with_spec(spec, [&] { comparison.results.push_back(examine(task, spec)); });
  return comparison;
}

}  // namespace radiosity

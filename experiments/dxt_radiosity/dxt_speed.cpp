#include "experiments/dxt_radiosity/dxt_speed.hpp"

#include "experiments/dxt_radiosity/bounce_methods.hpp"
#include "experiments/dxt_radiosity/improvement_steps.hpp"
#include "experiments/json_objects.hpp"
#include "experiments/machine.hpp"
#include "experiments/read_stream.hpp"
#include "experiments/taking_turns.hpp"
#include "foundation/error.hpp"
#include "foundation/output_file.hpp"
#include "foundation/parallel.hpp"
#include "scene/built_in.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <utility>

namespace radiosity {
namespace {

LitScene scene_of(const DxtSpeedOptions& options, Index patches, Monitor& monitor) {
  const auto mesh =
      std::make_shared<const PatchMesh>(make_patches(built_in_scene(options.scene), {.patches = patches}));
  return lit_scene(compute_form_factors(mesh, {.seed = options.seed}, monitor), options.lights, options.seed,
                   monitor);
}

double error_in_answer(const LitScene& scene, const BounceMethod& method, const Field& reference) {
  Field radiosity;
  method.answer(scene.emission, radiosity);
  return answer_errors(scene.mesh(), scene.emission, radiosity, reference).radiosity;
}

/// The solver with as large a residual as leaves it at most `error`, of those that are 1, 0.3, 0.1, ...
BounceMethod solver_as_good(const LitScene& scene, double error, const OperatorRegistry& operators,
                            const SolverRegistry& solvers) {
  constexpr double step = 0.316, least = 1e-6;
  double tolerance = step;
  const auto method = [&] {
    return solved_method(solved_kernel, kernel_variant, tolerance, scene.form_factors, operators, solvers);
  };
  while (tolerance > least && error_in_answer(scene, method(), scene.reference) > error) tolerance *= step;
  return method();
}

/// Reads as many bytes as a scalar F in float32 has.
Competitor reading_alone(Index patches) {
  const auto bytes = static_cast<std::size_t>(patches * patches) * sizeof(float);
  const auto stream = std::make_shared<ReadStream>(bytes);
  return {.name = "reading", .bytes = bytes, .work = [stream] {
            for (int quarter = 0; quarter < ReadStream::quarters; ++quarter) stream->read_quarter();
          }};
}

/// Times methods side by side with the first light, then measures their errors.
SpeedRound race(const LitScene& scene, long bounces, const std::vector<BounceMethod>& methods, double seconds,
                const OperatorRegistry& operators, Monitor& monitor) {
  monitor.checkpoint("bounces side by side", 0);
  const Field light = scene.emission.leftCols(scene.mesh().channels());
  Field radiosity(light.rows(), light.cols());
  std::vector<Competitor> competitors;
  competitors.reserve(methods.size() + 1);
  for (const BounceMethod& method : methods)
    competitors.push_back({.name = method.name, .columns = light.cols(), .bytes = method.bytes, .work = [&] {
                             method.answer(light, radiosity);
                           }});
  competitors.push_back(reading_alone(light.rows()));
  take_turns(competitors, 0);  // the first touches memory that later ones find in place
  take_turns(competitors, seconds);

  SpeedRound round{.patches = scene.mesh().patch_count(),
                   .channels = light.cols(),
                   .bounces = bounces,
                   .load = load_average(),
                   .reading = Timing::of(competitors.back().seconds),
                   .methods = {}};
  const auto exact = operators.make("dense", scene.form_factors);
  const Field after = after_bounces(*exact, scene.emission, bounces);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    std::optional<double> of_bounces;
    if (methods[i].name != solved_kernel) of_bounces = error_in_answer(scene, methods[i], after);
    round.methods.push_back({methods[i].name, methods[i].bytes, Timing::of(competitors[i].seconds),
                             of_bounces, error_in_answer(scene, methods[i], scene.reference)});
  }
  return round;
}

std::vector<BounceMethod> summed_methods(const LitScene& scene, long bounces,
                                         const OperatorRegistry& operators) {
  return {summed_method(float_sum, fmt::format("bounces:k={},storage=f32", bounces), scene.form_factors,
                        operators),
          summed_method(improved_sum, fmt::format("{},bounces={}", improved_variant, bounces),
                        scene.form_factors, operators)};
}

SpeedRound race_all(const LitScene& scene, const DxtSpeedOptions& options, const OperatorRegistry& operators,
                    const SolverRegistry& solvers, Monitor& monitor) {
  const long k = options.bounces;
  std::vector<BounceMethod> methods = {naive_method(scene.form_factors, k),
                                       packed_method(scene.form_factors, k),
                                       colour_method(scene.form_factors, k)};
  for (BounceMethod& method : summed_methods(scene, k, operators)) methods.push_back(std::move(method));
  const double error = error_in_answer(scene, methods.back(), scene.reference);
  methods.push_back(summed_method(document_sum, fmt::format("{}:bounces={}", document_variant, k),
                                  scene.form_factors, operators));
  methods.push_back(solver_as_good(scene, error, operators, solvers));
  return race(scene, k, methods, options.seconds, operators, monitor);
}

/// The document's two and who is between them; one sum only, as each of them takes products of n x n
/// matrices.
SpeedRound race_beyond_cache(const LitScene& scene, const DxtSpeedOptions& options,
                             const OperatorRegistry& operators, const SolverRegistry& solvers,
                             Monitor& monitor) {
  const long k = options.bounces;
  std::vector<BounceMethod> methods = {summed_method(
      document_sum, fmt::format("{}:bounces={}", document_variant, k), scene.form_factors, operators)};
  const double error = error_in_answer(scene, methods.front(), scene.reference);
  methods.push_back(solver_as_good(scene, error, operators, solvers));
  methods.push_back(packed_method(scene.form_factors, k));
  methods.push_back(naive_method(scene.form_factors, k));
  std::reverse(methods.begin(), methods.end());
  return race(scene, k, methods, options.seconds, operators, monitor);
}

SpeedRound race_over_bounces(const LitScene& scene, long bounces, double seconds,
                             const OperatorRegistry& operators, Monitor& monitor) {
  std::vector<BounceMethod> methods = {naive_method(scene.form_factors, bounces),
                                       packed_method(scene.form_factors, bounces)};
  for (BounceMethod& method : summed_methods(scene, bounces, operators)) methods.push_back(std::move(method));
  return race(scene, bounces, methods, seconds, operators, monitor);
}

Json rounds_json(const std::vector<SpeedRound>& rounds) {
  Json list = Json::array();
  for (const SpeedRound& round : rounds) {
    Json methods = Json::array();
    for (const MethodSpeed& method : round.methods)
      methods.push_back({{"name", method.name},
                         {"bytes", method.bytes},
                         {"min_seconds", method.time.min},
                         {"median_seconds", method.time.median},
                         {"error_of_bounces", or_null(method.error_of_bounces)},
                         {"error", method.error}});
    list.push_back({{"patches", round.patches},
                    {"bounces", round.bounces},
                    {"load", round.load},
                    {"seconds_to_read_factors", round.reading.min},
                    {"methods", methods}});
  }
  return list;
}

std::string csv_rounds(const std::vector<SpeedRound>& rounds) {
  std::string csv;
  for (const SpeedRound& round : rounds)
    for (const MethodSpeed& method : round.methods)
      csv += fmt::format("{},{},\"{}\",{},{:.6g},{:.6g},{:.6g}\n", round.patches, round.bounces, method.name,
                         method.bytes, method.time.min, method.time.median, method.error);
  return csv;
}

}  // namespace

const MethodSpeed* SpeedRound::find(const std::string& name) const {
  const auto own = std::find_if(methods.begin(), methods.end(),
                                [&](const MethodSpeed& method) { return method.name == name; });
  return own == methods.end() ? nullptr : &*own;
}

const MethodSpeed& SpeedRound::method(const std::string& name) const {
  if (const MethodSpeed* own = find(name)) return *own;
  fail("'{}' was not timed", name);
}

double SpeedRound::factor_bytes() const {
  return static_cast<double>(sizeof(float)) * static_cast<double>(patches) * static_cast<double>(patches);
}

DxtSpeeds measure_dxt_speeds(const DxtSpeedOptions& options, const OperatorRegistry& operators,
                             const SolverRegistry& solvers, Monitor& monitor) {
  if (options.patches.empty()) fail<UsageError>("times over patches need one number of patches at least");
  DxtSpeeds speeds{ThreadLimit::current(), {}, {}};
  for (const Index patches : options.patches)
    speeds.over_patches.push_back(
        race_all(scene_of(options, patches, monitor), options, operators, solvers, monitor));
  for (const Index patches : options.patches_beyond_cache)
    speeds.over_patches.push_back(
        race_beyond_cache(scene_of(options, patches, monitor), options, operators, solvers, monitor));
  if (options.bounce_counts.empty()) return speeds;
  const LitScene scene = scene_of(options, options.patches_over_bounces, monitor);
  for (const long bounces : options.bounce_counts)
    speeds.over_bounces.push_back(race_over_bounces(scene, bounces, options.seconds, operators, monitor));
  return speeds;
}

void write_dxt_speeds(const std::filesystem::path& folder, const DxtSpeeds& speeds,
                      const DeviceResults* device) {
  Json json = {{"threads", speeds.threads},
               {"over_patches", rounds_json(speeds.over_patches)},
               {"over_bounces", rounds_json(speeds.over_bounces)}};
  if (device != nullptr) json["device"] = device_results_json(*device);
  write_json(folder / "dxt_speed.json", json);
  OutputFile file(folder / "dxt_speed.csv");
  file.stream() << "patches,bounces,method,bytes,min_seconds,median_seconds,error\n"
                << csv_rounds(speeds.over_patches) << csv_rounds(speeds.over_bounces);
  file.commit();
}

ReportSection dxt_speed(const std::filesystem::path& folder, const std::string& command,
                        const DxtSpeedOptions& options, const OperatorRegistry& operators,
                        const SolverRegistry& solvers, Monitor& monitor) {
  make_folder(folder);
  const DxtSpeeds speeds = measure_dxt_speeds(options, operators, solvers, monitor);
  write_dxt_speeds(folder, speeds, options.device.get());
  return dxt_speed_section(speeds, options, command);
}

}  // namespace radiosity

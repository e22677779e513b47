#include "render/path_tracer.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "foundation/stopwatch.hpp"
#include "render/patch_rays.hpp"
#include "render/path_sampling.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>

namespace radiosity {
namespace {

/// Paths of one batch are stratified in position and direction, strata x strata each; batches are independent
/// of each other, so that their spread gives an honest standard error.
constexpr int strata = 4;
constexpr int batch_paths = strata * strata;

struct Counts {
  std::uint64_t rays = 0;
  std::uint64_t misses = 0;
  std::uint64_t back_hits = 0;
};

/// Running mean and spread of the batches of one patch (Welford).
struct Estimate {
  double batches = 0;
  Color mean = Color::Zero();
  Color squares = Color::Zero();

  void add(const Color& value) {
    batches += 1;
    const Color step = value - mean;
    mean += step / batches;
    squares += step * (value - mean);
  }
  Color standard_error() const { return (squares / (batches * (batches - 1))).sqrt(); }
};

class Tracer {
 public:
  Tracer(const PatchMesh& mesh, LightSampling lights)
      : mesh_(mesh),
        rays_(mesh),
        emitters_(mesh),
        combined_(lights == LightSampling::combined && !emitters_.empty()) {}

  /// Mean over one batch of paths that start on `patch`.
  Color batch(Index patch, RandomStream& random, Counts& counts) const;

 private:
  Color field(const Eigen::MatrixXd& values, Index patch) const {
    return values.cols() == 3 ? Color(values.row(patch).transpose().array())
                              : Color::Constant(values(patch, 0));
  }

  /// Irradiance gathered along one path; (u, v) chooses its first direction.
  Color path(Index patch, Vector3 point, double u, double v, RandomStream& random, Counts& counts) const;

  /// The weighted light from one random point of an emitter.
  Color emitter_sample(Index patch, const Vector3& point, RandomStream& random, Counts& counts) const;

  /// Solid-angle density with which emitter_sample chooses the direction from `point` to `target` on
  /// `emitter`.
  double emitter_density(Index emitter, const Vector3& point, const Vector3& target) const {
    const Vector3 apart = target - point;
    const double cosine = -apart.normalized().dot(mesh_.normal.col(emitter));
    return cosine > 0 ? emitters_.density(emitter) * apart.squaredNorm() / cosine : 0;
  }

  const PatchMesh& mesh_;
  PatchRays rays_;
  EmitterTable emitters_;
  bool combined_;
};

Color Tracer::batch(Index patch, RandomStream& random, Counts& counts) const {
  // Which stratum of directions goes with which stratum of positions is drawn anew for each batch.
  std::array<int, batch_paths> direction_stratum;
  for (int k = 0; k < batch_paths; ++k) direction_stratum[static_cast<std::size_t>(k)] = k;
  for (std::size_t k = batch_paths - 1; k > 0; --k)
    std::swap(direction_stratum[k], direction_stratum[random.below(k + 1)]);

  const auto jittered = [&random](int stratum) { return (stratum + random.uniform()) / strata; };
  Color sum = Color::Zero();
  for (int k = 0; k < batch_paths; ++k) {
    const double s = jittered(k / strata);
    const double t = jittered(k % strata);
    const int stratum = direction_stratum[static_cast<std::size_t>(k)];
    const double u = jittered(stratum / strata);
    const double v = jittered(stratum % strata);
    sum += path(patch, point_on_patch(mesh_, patch, s, t), u, v, random, counts);
  }
  return sum / batch_paths;
}

Color Tracer::path(Index patch, Vector3 point, double u, double v, RandomStream& random,
                   Counts& counts) const {
  Color gathered = Color::Zero();
  Color throughput = Color::Ones();
  while (true) {
    if (combined_) gathered += throughput * emitter_sample(patch, point, random, counts);

    const Vector3 normal = mesh_.normal.col(patch);
    const Vector3 direction = cosine_direction(normal, u, v);
    const PatchHit hit = rays_.from_patch(patch, point, direction);
    ++counts.rays;
    if (hit.missed() || !hit.front) {
      ++(hit.missed() ? counts.misses : counts.back_hits);
      return gathered;
    }
    double weight = 1;
    if (combined_ && emitters_.density(hit.patch) > 0) {
      const double here = direction.dot(normal) / std::numbers::pi;
      weight = here / (here + emitter_density(hit.patch, point, hit.point));
    }
    gathered += throughput * weight * field(mesh_.emission, hit.patch);

    throughput *= field(mesh_.reflectance, hit.patch);
    const double survival = std::min(1.0, throughput.maxCoeff());
    if (random.uniform() >= survival) return gathered;
    throughput /= survival;
    patch = hit.patch;
    point = hit.point;
    u = random.uniform();
    v = random.uniform();
  }
}

Color Tracer::emitter_sample(Index patch, const Vector3& point, RandomStream& random, Counts& counts) const {
  const Index emitter = emitters_.pick(random.uniform());
  const double s = random.uniform();
  const double t = random.uniform();
  const Vector3 target = point_on_patch(mesh_, emitter, s, t);
  const double cosine = (target - point).normalized().dot(mesh_.normal.col(patch));
  const double density = emitter_density(emitter, point, target);
  if (cosine <= 0 || density <= 0) return Color::Zero();  // one of the two faces away
  ++counts.rays;
  if (rays_.blocked(patch, point, emitter, target)) return Color::Zero();
  // E / pi * cosine / density, times the weight density / (density + cosine / pi): never above E.
  const double here = cosine / std::numbers::pi;
  return here / (density + here) * field(mesh_.emission, emitter);
}

void check(const PatchMesh& mesh, const PathTracingOptions& options) {
  if (options.paths <= 0)
    fail<UsageError>("{} paths from each patch are too few; at least 1 is needed", options.paths);
  if (!(options.standard_error >= 0) || !(options.seconds >= 0))
    fail<UsageError>("the path tracer's standard error ({}) and seconds ({}) must not be negative",
                     options.standard_error, options.seconds);
  if (mesh.channels() != 1 && mesh.channels() != 3)
    fail<UsageError>("the path tracer follows 1 or 3 channels, not {}", mesh.channels());
  if (mesh.emission.rows() != mesh.patch_count() || mesh.emission.cols() != mesh.channels())
    fail<UsageError>("emission is {} x {}; the path tracer needs {} x {}", mesh.emission.rows(),
                     mesh.emission.cols(), mesh.patch_count(), mesh.channels());
  for (Index i = 0; i < mesh.patch_count(); ++i)
    if (!(mesh.reflectance.row(i).maxCoeff() < 1))
      fail<UsageError>(
          "patch {} has reflectance {}: paths between such patches need not end; limit it below 1", i,
          mesh.reflectance.row(i).maxCoeff());
}

}  // namespace

double PathTracedIrradiance::relative_standard_error(const Eigen::VectorXd& area) const {
  const double squares = (area.asDiagonal() * standard_error.cwiseAbs2()).sum();
  const double weight = area.sum() * static_cast<double>(irradiance.cols());
  const double mean = (area.asDiagonal() * irradiance).sum() / weight;
  return mean > 0 ? std::sqrt(squares / weight) / mean : 0;
}

PathTracedIrradiance trace_paths(const PatchMesh& mesh, const PathTracingOptions& options, Monitor& monitor) {
  check(mesh, options);
  const Stopwatch stopwatch;
  const Tracer tracer(mesh, options.lights);
  const auto n = static_cast<std::size_t>(mesh.patch_count());
  const auto batches =
      static_cast<std::uint64_t>(std::max(4, (options.paths + batch_paths - 1) / batch_paths));
  std::vector<Estimate> estimates(n);
  std::vector<Counts> counts(n);
  PathTracedIrradiance result;
  result.irradiance.resize(mesh.patch_count(), mesh.channels());
  result.standard_error.resize(mesh.patch_count(), mesh.channels());

  for (std::uint64_t round = 0;; ++round) {
    std::atomic<std::size_t> done{0};
    parallel_for(n, [&](std::size_t i) {
      RandomStream random(options.seed, round * n + i);
      for (std::uint64_t k = 0; k < batches; ++k)
        estimates[i].add(tracer.batch(static_cast<Index>(i), random, counts[i]));
      monitor.checkpoint("path tracing", static_cast<double>(++done) / static_cast<double>(n));
    });
    for (std::size_t i = 0; i < n; ++i) {
      const auto row = static_cast<Index>(i);
      result.irradiance.row(row) = estimates[i].mean.head(mesh.channels()).matrix().transpose();
      result.standard_error.row(row) =
          estimates[i].standard_error().head(mesh.channels()).matrix().transpose();
    }
    result.paths += batches * batch_paths;
    const bool exact_enough =
        options.standard_error > 0 && result.relative_standard_error(mesh.area) <= options.standard_error;
    const bool out_of_time = options.seconds > 0 && stopwatch.seconds() >= options.seconds;
    if (exact_enough || out_of_time || (options.standard_error == 0 && options.seconds == 0)) break;
  }

  for (const Counts& patch : counts) {
    result.rays += patch.rays;
    result.misses += patch.misses;
    result.back_hits += patch.back_hits;
  }
  result.leaks = mesh.topology.enclosure ? result.misses : 0;
  result.seconds = stopwatch.seconds();
  return result;
}

}  // namespace radiosity

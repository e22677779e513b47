#include "experiments/low_rank_radiosity/changing_lights.hpp"

#include "experiments/low_rank_radiosity/precomputed_woodbury.hpp"
#include "experiments/low_rank_radiosity/shared_factor_frame.hpp"
#include "experiments/machine.hpp"
#include "experiments/reference_solution.hpp"
#include "experiments/taking_turns.hpp"
#include "form_factors/coherent_mesh.hpp"
#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "foundation/stopwatch.hpp"
#include "kernels/segment_sums.hpp"
#include "operators/direct_two_mesh.hpp"
#include "scene/built_in.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace radiosity {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The patches of one group that shine.
struct Lamp {
  std::vector<Index> patches;
  Vector3 middle = Vector3::Zero();
};

std::vector<Lamp> lamps_of(const PatchMesh& mesh) {
  std::vector<Lamp> groups(mesh.scene->groups.size());
  std::vector<double> areas(groups.size(), 0);
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    if (mesh.emission.row(i).maxCoeff() <= 0) continue;
    const auto group = static_cast<std::size_t>(mesh.patches[static_cast<std::size_t>(i)].group);
    groups[group].patches.push_back(i);
    groups[group].middle += mesh.area[i] * mesh.centroid.col(i);
    areas[group] += mesh.area[i];
  }
  std::vector<Lamp> lamps;
  for (std::size_t group = 0; group < groups.size(); ++group) {
    if (groups[group].patches.empty()) continue;
    groups[group].middle /= areas[group];
    lamps.push_back(std::move(groups[group]));
  }
  if (lamps.empty()) fail<UsageError>("'{}' has no lamp that could change", mesh.scene->name);
  return lamps;
}

/// A lit arc runs once around the vertical axis through the middle of all lamps: one way in the lower half of
/// them, the other way in the upper.
MatrixXd turning_powers(const std::vector<Lamp>& lamps, int frames) {
  Vector3 middle = Vector3::Zero();
  for (const Lamp& lamp : lamps) middle += lamp.middle / static_cast<double>(lamps.size());
  MatrixXd powers(frames, static_cast<Index>(lamps.size()));
  for (std::size_t l = 0; l < lamps.size(); ++l) {
    const Vector3 arm = lamps[l].middle - middle;
    const double place = std::atan2(arm.z(), arm.x());
    const double sense = arm.y() > 0 ? -1 : 1;
    for (int t = 0; t < frames; ++t) {
      const double phase = sense * 2 * std::numbers::pi * t / frames - place;
      powers(t, static_cast<Index>(l)) = std::pow((1 + std::cos(phase)) / 2, 3);
    }
  }
  return powers;
}

/// A room whose fields are sorted by patch, lit frame by frame.
class LampRoom {
 public:
  LampRoom(const PatchMesh& mesh, const ChangingLightsOptions& options, ChangingLights& lights,
           Monitor& monitor)
      : lamps_(lamps_of(mesh)) {
    lights.powers = turning_powers(lamps_, options.frames);
    const Stopwatch factor_watch;
    const auto coarse =
        coherent_coarse_mesh(mesh, options.coarse_patches, Assignment::inclusion, {.seed = options.seed});
    if (!coarse)
      fail<UsageError>("'{}' has more than {} faces: ask for a larger k", mesh.scene->name,
                       options.coarse_patches);
    factors_ = std::make_unique<DirectTwoMeshFactors>(compute_two_mesh_factors(
        mesh, *coarse, {.tolerance = options.tolerance, .seed = options.seed}, monitor));
    lights.coarse_patches = coarse->patches.patch_count();
    lights.rays = factors_->rays;
    lights.factor_seconds = factor_watch.seconds();

    sort(mesh);
    const Stopwatch fold_watch;
    for (Index channel = 0; channel < mesh.channels(); ++channel)
      Y_.push_back(precompute_woodbury(factors_->V, factors_->U.clone(), reflectance_.col(channel), monitor));
    lights.fold_seconds = fold_watch.seconds();
    const Stopwatch shared_watch;
    shared_ = std::make_unique<SharedFactorFrame>(factors_->V, factors_->U, reflectance_);
    lights.shared_seconds = shared_watch.seconds();
    lights.three_factor_bytes = factors_->V.offset_bytes() + factors_->V.weight_bytes();
    for (const TallMatrix<float>& factor : Y_) lights.three_factor_bytes += factor.entry_bytes();
    lights.shared_factor_bytes = shared_->bytes();
    B_.resize(mesh.patch_count(), mesh.channels());
    E_ = MatrixXd::Zero(mesh.patch_count(), mesh.channels());
    sums_.resize(lights.coarse_patches, mesh.channels());
  }

  /// Sets E of the lamps.
  void light(const Eigen::Ref<const Eigen::RowVectorXd>& powers) {
    for (std::size_t l = 0; l < lamps_.size(); ++l)
      for (const Index i : lamps_[l].patches) E_.row(i) = powers[static_cast<Index>(l)] * emission_.row(i);
  }

  void solve_channel(Index channel) {
    segment_sums(factors_->V, E_.col(channel), sums_.col(channel), RowOrder::sorted);
    subtract_product(Y_[static_cast<std::size_t>(channel)], sums_.col(channel), E_.col(channel),
                     B_.col(channel));
  }

  void solve_with_three_factors() {
    for (Index channel = 0; channel < E_.cols(); ++channel) solve_channel(channel);
  }

  void solve_with_shared_factor() { shared_->solve(E_, B_); }

  /// B in the order of the mesh.
  Field radiosity() const {
    if (factors_->V.order().empty()) return B_;
    Field B(B_.rows(), B_.cols());
    B(factors_->V.order(), Eigen::all) = B_;
    return B;
  }

 private:
  void sort(const PatchMesh& mesh) {
    reflectance_ = mesh.reflectance;
    emission_ = mesh.emission;
    const std::vector<std::int32_t>& order = factors_->V.order();
    if (order.empty()) return;
    reflectance_ = MatrixXd(mesh.reflectance(order, Eigen::all));
    emission_ = MatrixXd(mesh.emission(order, Eigen::all));
    std::vector<Index> place(order.size());
    for (std::size_t s = 0; s < order.size(); ++s)
      place[static_cast<std::size_t>(order[s])] = static_cast<Index>(s);
    for (Lamp& lamp : lamps_)
      for (Index& patch : lamp.patches) patch = place[static_cast<std::size_t>(patch)];
  }

  std::vector<Lamp> lamps_;  ///< patches as sorted
  std::unique_ptr<DirectTwoMeshFactors> factors_;
  std::vector<TallMatrix<float>> Y_;
  std::unique_ptr<SharedFactorFrame> shared_;
  MatrixXd reflectance_;
  MatrixXd emission_;
  MatrixXd E_;
  MatrixXd B_;
  MatrixXd sums_;
};

LightFrameTimes time_light_frames(LampRoom& room, const MatrixXd& powers, double seconds) {
  Index frame = 0;
  const auto next = [&] {
    room.light(powers.row(frame));
    frame = (frame + 1) % powers.rows();
  };
  constexpr int turns_together = 4;
  const auto competitor = [&](const char* name, const std::function<void()>& solve) {
    return Competitor{name, 1, 0,
                      [&next, solve] {
                        next();
                        solve();
                      },
                      turns_together};
  };
  std::vector<Competitor> competitors = {
      competitor("one channel", [&room] { room.solve_channel(0); }),
      competitor("three factors", [&room] { room.solve_with_three_factors(); }),
      competitor("shared factor", [&room] { room.solve_with_shared_factor(); })};
  take_turns(competitors, seconds);
  const auto timing = [&](std::size_t i) {
    return Timing{competitors[i].seconds_min(), competitors[i].seconds_median()};
  };
  return {ThreadLimit::current(), timing(0), timing(1), timing(2)};
}

/// E of all frames in the order of the mesh, the channels of a frame together.
Field all_emissions(const PatchMesh& mesh, const MatrixXd& powers) {
  const std::vector<Lamp> lamps = lamps_of(mesh);
  Field emission = Field::Zero(mesh.patch_count(), powers.rows() * mesh.channels());
  for (Index t = 0; t < powers.rows(); ++t)
    for (std::size_t l = 0; l < lamps.size(); ++l)
      for (const Index i : lamps[l].patches)
        emission.row(i).segment(t * mesh.channels(), mesh.channels()) =
            powers(t, static_cast<Index>(l)) * mesh.emission.row(i);
  return emission;
}

}  // namespace

ChangingLights measure_changing_lights(const ChangingLightsOptions& options, Monitor& monitor) {
  if (options.frames < 1 || options.pictures < 1 || options.pictures > options.frames)
    fail<UsageError>("{} pictures of {} frames: there must be one of each, and no more pictures than frames",
                     options.pictures, options.frames);
  ChangingLights lights;
  lights.load_before = load_average();
  lights.mesh = std::make_shared<const PatchMesh>(
      make_patches(built_in_scene(options.scene), {.patches = options.patches}));
  const PatchMesh& mesh = *lights.mesh;
  LampRoom room(mesh, options, lights, monitor);
  for (const int threads : {1, 0}) {
    const ThreadLimit limit(threads);
    monitor.checkpoint("timing frames", 0);
    lights.times.push_back(time_light_frames(room, lights.powers, options.seconds / 2));
  }

  for (int p = 0; p < options.pictures; ++p) lights.drawn.push_back(p * options.frames / options.pictures);
  Field answers(mesh.patch_count(), lights.powers.rows() * mesh.channels());
  for (Index t = 0; t < lights.powers.rows(); ++t) {
    monitor.checkpoint("frames", static_cast<double>(t) / static_cast<double>(lights.powers.rows()));
    room.light(lights.powers.row(t));
    room.solve_with_three_factors();
    const Field with_three = room.radiosity();
    room.solve_with_shared_factor();
    const Field B = room.radiosity();
    answers.middleCols(t * mesh.channels(), mesh.channels()) = B;
    for (const double difference : relative_errors(mesh, with_three, B))
      lights.largest_disagreement = std::max(lights.largest_disagreement, difference);
    if (std::find(lights.drawn.begin(), lights.drawn.end(), static_cast<int>(t)) != lights.drawn.end())
      lights.radiosity.push_back(B);
  }
  if (mesh.patch_count() <= options.largest_dense) {
    const FormFactors form_factors = compute_form_factors(lights.mesh, {.seed = options.seed}, monitor);
    const std::optional<Field> exact = reference_solution(form_factors, all_emissions(mesh, lights.powers));
    if (!exact) fail("no solver finds the radiosity of {}", options.scene);
    lights.errors = relative_errors(mesh, answers, *exact);
  }
  lights.load_after = load_average();
  return lights;
}

}  // namespace radiosity

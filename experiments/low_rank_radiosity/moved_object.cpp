#include "experiments/low_rank_radiosity/moved_object.hpp"

#include "experiments/low_rank_radiosity/shared_factor_frame.hpp"
#include "experiments/reference_solution.hpp"
#include "form_factors/moved_pairs.hpp"
#include "foundation/error.hpp"
#include "foundation/stopwatch.hpp"
#include "operators/direct_two_mesh.hpp"
#include "scene/patch_mesh.hpp"
#include "scene/scene_builder.hpp"

#include <array>
#include <optional>
#include <utility>

namespace radiosity {
namespace {

constexpr double room_side = 5;
constexpr double box_side = 0.75;
constexpr double box_bottom = 0.75;
constexpr double box_front = 1.25;  // from the back wall

/// A rectangle from its first corner along two edges; its front is where their cross product points.
void rectangle(SceneBuilder& builder, const Vector3& corner, const Vector3& u, const Vector3& v, int material,
               int group) {
  builder.face({corner, corner + u, corner + u + v, corner + v}, material, group);
}

void add_box(SceneBuilder& builder, double left) {
  const int material = builder.material({"box", Color(0.75, 0.7, 0.6), Color::Zero()});
  const int group = builder.group("box");
  const Vector3 low(left, box_bottom, box_front);
  const Vector3 x(box_side, 0, 0), y(0, box_side, 0), z(0, 0, box_side);
  rectangle(builder, low, z, y, material, group);      // left, looks towards -x
  rectangle(builder, low + x, y, z, material, group);  // right
  rectangle(builder, low, x, z, material, group);      // below
  rectangle(builder, low + y, z, x, material, group);  // above
  rectangle(builder, low, y, x, material, group);      // back
  rectangle(builder, low + z, x, y, material, group);  // front
}

/// The ceiling is 4 x 4 faces, the four in the middle shine.
void add_ceiling(SceneBuilder& builder, int white, int lamp) {
  constexpr int cells = 4;
  constexpr double side = room_side / cells;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const bool inner = (i == 1 || i == 2) && (j == 1 || j == 2);
      rectangle(builder, {i * side, room_side, j * side}, {side, 0, 0}, {0, 0, side}, inner ? lamp : white,
                builder.group(inner ? "lamp" : "ceiling"));
    }
}

struct BoxPlace {
  std::shared_ptr<const PatchMesh> elements;
  CoarseMesh coarse;
  std::vector<bool> moved;  ///< for each face, whether it is the box's
};

BoxPlace box_place(const MovedObjectOptions& options, double place) {
  const Scene scene = room_with_hovering_box(place);
  BoxPlace result;
  result.elements = std::make_shared<const PatchMesh>(make_patches(scene, {.patches = options.patches}));
  std::optional<CoarseMesh> coarse =
      uniform_coarse_mesh(*result.elements, options.coarse_patches, Assignment::inclusion);
  if (!coarse)
    fail<UsageError>("the room with a box has more than {} faces: ask for a larger k",
                     options.coarse_patches);
  result.coarse = std::move(*coarse);
  for (const Face& face : result.elements->scene->faces)
    result.moved.push_back(result.elements->scene->groups[static_cast<std::size_t>(face.group)] == "box");
  return result;
}

DirectTwoMeshFactors clone(const DirectTwoMeshFactors& factors) {
  return {factors.V, factors.U.clone(), factors.rays};
}

struct Answer {
  Field radiosity;  ///< in the order of the mesh
  double fold_seconds = 0;
  double frame_seconds = 0;
};

Answer answer_of(const DirectTwoMeshFactors& factors, const PatchMesh& mesh) {
  Eigen::MatrixXd reflectance = mesh.reflectance, emission = mesh.emission;
  const std::vector<std::int32_t>& order = factors.V.order();
  if (!order.empty()) {
    reflectance = Eigen::MatrixXd(mesh.reflectance(order, Eigen::all));
    emission = Eigen::MatrixXd(mesh.emission(order, Eigen::all));
  }
  Answer answer;
  const Stopwatch fold_watch;
  SharedFactorFrame frame(factors.V, factors.U, reflectance);
  answer.fold_seconds = fold_watch.seconds();
  Field B(emission.rows(), emission.cols());
  const Stopwatch frame_watch;
  frame.solve(emission, B);
  answer.frame_seconds = frame_watch.seconds();
  answer.radiosity = B;
  if (!order.empty()) answer.radiosity(order, Eigen::all) = B;
  return answer;
}

double difference(const TallMatrix<float>& U, const TallMatrix<float>& reference) {
  double difference = 0, norm = 0;
  for (Index e = 0; e < U.rows(); ++e)
    for (Index p = 0; p < U.columns(); ++p) {
      difference += std::pow(U(e, p) - reference(e, p), 2);
      norm += std::pow(reference(e, p), 2);
    }
  return std::sqrt(difference / norm);
}

class BoxInRoom {
 public:
  BoxInRoom(const MovedObjectOptions& options, Monitor& monitor)
      : options_(options),
        monitor_(monitor),
        place_(box_place(options, place_of(0))),
        updated_(compute(place_)),
        stale_(clone(updated_)) {}

  Index coarse_patches() const { return updated_.U.columns(); }

  /// Moves the box to its place number `step`.
  MovedObjectStep move(int step, MovedObject& object) {
    MovedObjectStep result;
    result.place = place_of(step);
    BoxPlace next = box_place(options_, result.place);
    const Stopwatch update_watch;
    const MovedPairs pairs(*place_.elements, *next.elements, next.coarse.patches, next.moved);
    update(updated_, next, [&pairs](Index e, Index p) { return pairs(e, p); });
    result.update_seconds = update_watch.seconds();
    result.changed = pairs.fraction();
    DirectTwoMeshFactors own = clone(stale_);
    update(own, next, [&pairs](Index e, Index p) { return pairs.has_moved(e, p); });
    const Stopwatch rebuild_watch;
    const DirectTwoMeshFactors rebuilt = compute(next);
    result.rebuild_seconds = rebuild_watch.seconds();
    result.factor_difference = difference(updated_.U, rebuilt.U);

    const PatchMesh& mesh = *next.elements;
    const Stopwatch dense_watch;
    const FormFactors form_factors = compute_form_factors(next.elements, {.seed = options_.seed}, monitor_);
    result.dense_seconds = dense_watch.seconds();
    const std::optional<Field> exact = reference_solution(form_factors, mesh.emission);
    if (!exact) fail("no solver finds the radiosity of the room with a box");
    const auto error = [&](const Field& B) { return relative_errors(mesh, B, *exact).front(); };
    Answer answer = answer_of(updated_, mesh);
    result.fold_seconds = answer.fold_seconds;
    result.frame_seconds = answer.frame_seconds;
    result.updated_error = error(answer.radiosity);
    result.stale_error = error(answer_of(stale_, mesh).radiosity);
    result.own_error = error(answer_of(own, mesh).radiosity);
    result.rebuilt_error = error(answer_of(rebuilt, mesh).radiosity);
    object.meshes.push_back(next.elements);
    object.radiosity.push_back(std::move(answer.radiosity));
    place_ = std::move(next);
    return result;
  }

 private:
  double place_of(int step) const {
    constexpr double gap = 0.25;  // to the walls at both ends
    const double first = gap + box_side / 2, last = room_side - first;
    return first + (last - first) * step / options_.steps;
  }

  ElementFactorOptions factor_options() const {
    return {.tolerance = options_.tolerance, .seed = options_.seed, .wanted = {}};
  }

  DirectTwoMeshFactors compute(const BoxPlace& place) const {
    return compute_two_mesh_factors(*place.elements, place.coarse, factor_options(), monitor_);
  }

  void update(DirectTwoMeshFactors& factors, const BoxPlace& place, ElementFactorChoice wanted) const {
    ElementFactorOptions only = factor_options();
    only.wanted = std::move(wanted);
    update_two_mesh_factors(factors, *place.elements, place.coarse, only, monitor_);
  }

  const MovedObjectOptions& options_;
  Monitor& monitor_;
  BoxPlace place_;
  DirectTwoMeshFactors updated_;
  DirectTwoMeshFactors stale_;
};

}  // namespace

Scene room_with_hovering_box(double place) {
  SceneBuilder builder("room-with-a-box");
  const int white = builder.material({"white", Color::Constant(0.7), Color::Zero()});
  const int red = builder.material({"red", Color(0.6, 0.1, 0.08), Color::Zero()});
  const int green = builder.material({"green", Color(0.15, 0.5, 0.12), Color::Zero()});
  const int lamp = builder.material({"lamp", Color::Constant(0.7), Color(18, 16, 13)});
  const Vector3 x(room_side, 0, 0), y(0, room_side, 0), z(0, 0, room_side), origin(0, 0, 0);
  rectangle(builder, origin, z, x, white, builder.group("floor"));
  rectangle(builder, origin, y, z, red, builder.group("left"));
  rectangle(builder, x, z, y, green, builder.group("right"));
  rectangle(builder, origin, x, y, white, builder.group("back"));
  rectangle(builder, z, y, x, white, builder.group("front"));
  add_ceiling(builder, white, lamp);
  add_box(builder, place - box_side / 2);
  Scene scene = std::move(builder.scene());
  scene.camera = Camera{{room_side / 2, room_side / 2, room_side - 0.01},
                        {room_side / 2, room_side / 2, 0},
                        Vector3::UnitY(),
                        75};
  return scene;
}

MovedObject measure_moved_object(const MovedObjectOptions& options, Monitor& monitor) {
  if (options.steps < 1) fail<UsageError>("a box that moves by {} steps stands still", options.steps);
  MovedObject object;
  BoxInRoom room(options, monitor);
  for (int step = 1; step <= options.steps; ++step) {
    monitor.checkpoint("moving a box", static_cast<double>(step - 1) / options.steps);
    object.steps.push_back(room.move(step, object));
  }
  object.coarse_patches = room.coarse_patches();
  object.mesh = object.meshes.back();
  return object;
}

}  // namespace radiosity

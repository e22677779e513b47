#include "experiments/hard_case_scenes.hpp"

#include "scene/import.hpp"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace radiosity {
namespace {

FormFactors trace(const std::string& name, Index patches) {
  SilentMonitor monitor;
  const auto mesh = std::make_shared<const PatchMesh>(make_patches(open_scene(name), {.patches = patches}));
  return compute_form_factors(mesh, {}, monitor);
}

KnownSolution with_mean_light(const exact_rooms::Room& room, const Field& emission, double f) {
  const double rho = room.reflectance(0, 0);
  const double mean = room.area.dot(emission.col(0)) / room.area.sum();
  return {form_factors_of(room), emission, emission.array() + rho * f * mean / (1 - rho * f)};
}

}  // namespace

FormFactors traced_scene(const std::string& name, Index patches, double reflectance) {
  static std::map<std::pair<std::string, Index>, FormFactors> traced;
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  const std::pair key(name, patches);
  auto found = traced.find(key);
  if (found == traced.end()) found = traced.emplace(key, trace(name, patches)).first;
  FormFactors form_factors = found->second;
  if (reflectance > 0) {
    auto mesh = std::make_shared<PatchMesh>(*form_factors.mesh);
    mesh->reflectance.setConstant(reflectance);
    form_factors.mesh = std::move(mesh);
  }
  return form_factors;
}

KnownSolution furnace(Index patches, double reflectance) {
  const exact_rooms::Room room = exact_rooms::closed_room(patches, 21, reflectance);
  const Field emission = Field::Constant(patches, 1, 2.5);
  return {form_factors_of(room), emission, emission / (1 - reflectance)};
}

KnownSolution lit_sphere(Index patches, double reflectance) {
  const exact_rooms::Room room = exact_rooms::sphere_cavity(patches, 22, reflectance);
  return with_mean_light(room, exact_rooms::random_lights(patches, 1, 23), 1);
}

KnownSolution lit_bowl(Index patches, double reflectance) {
  const exact_rooms::Room room = exact_rooms::spherical_bowl(patches, 24, 60, reflectance);
  Field emission = exact_rooms::random_lights(patches, 1, 25);
  emission.topRows(patches / 2).setZero();  // the dark part
  return with_mean_light(room, emission, 0.25);
}

}  // namespace radiosity

#include "experiments/lights.hpp"

#include "experiments/area_light.hpp"
#include "experiments/point_light.hpp"
#include "foundation/error.hpp"
#include "foundation/random.hpp"

#include <charconv>
#include <optional>
#include <set>
#include <string_view>

namespace radiosity {

namespace {

Index parse_count(std::string_view item, std::string_view digits) {
  constexpr Index most = 100000;
  Index count = -1;
  const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
  if (problem != std::errc() || end != digits.data() + digits.size() || count < 0 || count > most)
    fail<UsageError>("The number of lights in '{}' is not a whole number from 0 to {}.", item, most);
  return count;
}

/// Streams of different kinds never meet.
RandomStream light_stream(std::uint64_t seed, LightKind kind, Index number) {
  return RandomStream(seed, (static_cast<std::uint64_t>(kind) << 32) + static_cast<std::uint64_t>(number));
}

Light draw_patch_light(const PatchMesh& mesh, RandomStream& random) {
  Light light;
  light.kind = LightKind::patch;
  light.patch = static_cast<Index>(random.below(static_cast<std::uint64_t>(mesh.patch_count())));
  light.position = mesh.centroid.col(light.patch);
  return light;
}

}  // namespace

LightCounts LightCounts::parse(const std::string& text) {
  LightCounts counts;
  std::set<std::string_view> seen;
  std::string_view rest = text;
  while (true) {
    const auto comma = rest.find(',');
    const std::string_view item = rest.substr(0, comma);
    const auto colon = item.find(':');
    const std::string_view kind = item.substr(0, colon);
    if (colon == std::string_view::npos || (kind != "area" && kind != "point" && kind != "patch"))
      fail<UsageError>(
          "'{}' is no kind and number of lights: write area:N, point:N or patch:N, separated by commas.",
          item);
    if (!seen.insert(kind).second) fail<UsageError>("'{}' lights are asked for twice in '{}'.", kind, text);
    const Index count = parse_count(item, item.substr(colon + 1));
    (kind == "area" ? counts.area : kind == "point" ? counts.point : counts.patch) = count;
    if (comma == std::string_view::npos) return counts;
    rest.remove_prefix(comma + 1);
  }
}

LightSet draw_lights(const PatchMesh& mesh, const LightCounts& counts, std::uint64_t seed, Monitor& monitor) {
  if (counts.total() > 0 && mesh.patch_count() == 0) fail("A scene without patches has no place for lights.");
  LightSet set;
  set.emission = Eigen::MatrixXd::Zero(mesh.patch_count(), counts.total() * mesh.channels());
  const auto add = [&](const Light& light, const Eigen::MatrixXd& emission) {
    monitor.checkpoint("lights",
                       static_cast<double>(set.lights.size()) / static_cast<double>(counts.total()));
    set.emission.middleCols(static_cast<Index>(set.lights.size()) * mesh.channels(), mesh.channels()) =
        emission;
    set.lights.push_back(light);
  };

  for (Index k = 0; k < counts.area; ++k) {
    RandomStream random = light_stream(seed, LightKind::area, k);
    const Light light = draw_area_light(mesh, random);
    add(light, area_light_cover(mesh, light).replicate(1, mesh.channels()));
  }
  std::optional<PointLights> points;
  if (counts.point > 0) points.emplace(mesh);
  for (Index k = 0; k < counts.point; ++k) {
    RandomStream random = light_stream(seed, LightKind::point, k);
    const auto [light, irradiance] = points->draw(random);
    add(light, mesh.reflectance.array().colwise() * irradiance.array());
  }
  for (Index k = 0; k < counts.patch; ++k) {
    RandomStream random = light_stream(seed, LightKind::patch, k);
    const Light light = draw_patch_light(mesh, random);
    Eigen::MatrixXd emission = Eigen::MatrixXd::Zero(mesh.patch_count(), mesh.channels());
    emission.row(light.patch).setOnes();
    add(light, emission);
  }
  return set;
}

}  // namespace radiosity

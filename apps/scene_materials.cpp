#include "apps/scene_materials.hpp"

#include "foundation/error.hpp"
#include "foundation/npy.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <system_error>

namespace radiosity {
namespace {

/// "GROUP:key=value,..." taken apart.
struct GroupSetting {
  std::string group;
  std::optional<Color> reflectance;
  std::optional<Color> emission;
};

double parse_number(const std::string& setting, std::string_view text, double high) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool valid = error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
  if (!valid || value < 0 || value > high)
    fail<UsageError>("--set {}: '{}' is not a number {}", setting, text,
                     high == 1 ? "in [0, 1]" : "of at least 0");
  return value;
}

/// One number, or three with '/' between.
Color parse_color(const std::string& setting, std::string_view text, double high) {
  const auto first = text.find('/');
  if (first == std::string_view::npos) return Color::Constant(parse_number(setting, text, high));
  const auto second = text.find('/', first + 1);
  if (second == std::string_view::npos || text.find('/', second + 1) != std::string_view::npos)
    fail<UsageError>("--set {}: '{}' is neither one number nor three as in 0.7/0.2/0.1", setting, text);
  return {parse_number(setting, text.substr(0, first), high),
          parse_number(setting, text.substr(first + 1, second - first - 1), high),
          parse_number(setting, text.substr(second + 1), high)};
}

GroupSetting parse_group_setting(const std::string& text) {
  const auto colon = text.rfind(':');  // a group's name may contain one
  if (colon == std::string::npos || colon == 0 || colon + 1 == text.size())
    fail<UsageError>("--set {}: write it as GROUP:reflectance=0.5 or GROUP:emission=1/1/0.8", text);
  GroupSetting setting;
  setting.group = text.substr(0, colon);
  std::string_view rest = std::string_view(text).substr(colon + 1);
  while (!rest.empty()) {
    const auto comma = std::min(rest.find(','), rest.size());
    const std::string_view entry = rest.substr(0, comma);
    rest.remove_prefix(std::min(comma + 1, rest.size()));
    const auto equals = std::min(entry.find('='), entry.size());
    const std::string_view key = entry.substr(0, equals);
    const std::string_view value = entry.substr(std::min(equals + 1, entry.size()));
    if (key == "reflectance")
      setting.reflectance = parse_color(text, value, 1);
    else if (key == "emission")
      setting.emission = parse_color(text, value, std::numeric_limits<double>::max());
    else
      fail<UsageError>("--set {}: there is no key '{}'; the known ones are reflectance and emission", text,
                       key);
  }
  return setting;
}

/// The groups that have patches, as an error message lists them.
std::string group_list(const PatchMesh& mesh) {
  constexpr std::size_t shown = 20;
  const std::vector<std::string>& groups = mesh.scene->groups;
  std::string list;
  for (std::size_t k = 0; k < std::min(groups.size(), shown); ++k) list += (k > 0 ? ", " : "") + groups[k];
  return groups.size() > shown ? list + fmt::format(" and {} more", groups.size() - shown) : list;
}

void set_group(PatchMesh& mesh, const std::string& text) {
  const GroupSetting setting = parse_group_setting(text);
  Index found = 0;
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const auto group = static_cast<std::size_t>(mesh.patches[static_cast<std::size_t>(i)].group);
    if (mesh.scene->groups[group] != setting.group) continue;
    ++found;
    if (setting.reflectance) mesh.reflectance.row(i) = setting.reflectance->matrix().transpose();
    if (setting.emission) mesh.emission.row(i) = setting.emission->matrix().transpose();
  }
  if (found == 0)
    fail<UsageError>("--set {}: the scene has no group '{}'; its groups are {}", text, setting.group,
                     group_list(mesh));
}

void set_emission(PatchMesh& mesh, const std::string& file) {
  const Eigen::MatrixXd emission = read_npy(file);
  if (emission.rows() != mesh.patch_count() || (emission.cols() != 1 && emission.cols() != 3))
    fail("'{}' is {} x {}; the emission of this mesh is {} x 1 or {} x 3", file, emission.rows(),
         emission.cols(), mesh.patch_count(), mesh.patch_count());
  for (Index i = 0; i < emission.rows(); ++i)
    if (emission.row(i).minCoeff() < 0)
      fail("'{}' has a negative emission at patch {}: it must be at least 0", file, i);
  for (Index channel = 0; channel < 3; ++channel)
    mesh.emission.col(channel) = emission.col(channel % emission.cols());
}

bool grey(const Eigen::MatrixXd& field) {
  return field.col(0) == field.col(1) && field.col(0) == field.col(2);
}

}  // namespace

void apply_materials(PatchMesh& mesh, const MaterialSettings& settings) {
  if (mesh.channels() == 1) {
    mesh.reflectance = mesh.reflectance.replicate(1, 3).eval();
    mesh.emission = mesh.emission.replicate(1, 3).eval();
  }
  if (settings.reflectance) mesh.reflectance.setConstant(*settings.reflectance);
  if (!settings.emission_file.empty()) set_emission(mesh, settings.emission_file);
  for (const std::string& setting : settings.group_settings) set_group(mesh, setting);
  if (grey(mesh.reflectance) && grey(mesh.emission)) {
    mesh.reflectance = mesh.reflectance.leftCols(1).eval();
    mesh.emission = mesh.emission.leftCols(1).eval();
  }
}

}  // namespace radiosity

#include "scene/mtl_scan.hpp"

#include "foundation/error.hpp"
#include "scene/text_lines.hpp"

namespace radiosity {
namespace {

Color read_color(const TextLines& lines, bool reflectance) {
  const std::string_view name = lines.words().front();
  if (lines.words().size() > 1 && (lines.words()[1] == "spectral" || lines.words()[1] == "xyz"))
    lines.fail_here(fmt::format("{} must be given as RGB", name));
  if (lines.words().size() < 2)
    lines.fail_here(fmt::format("{} needs numbers; the line may be truncated", name));
  Color color = Color::Zero();
  for (std::size_t k = 1; k < lines.words().size() && k <= 3; ++k) {
    const double value = lines.finite_number(k);
    if (value < 0) lines.fail_here(fmt::format("{} {} is negative", name, value));
    if (reflectance && value > 1)
      lines.fail_here(fmt::format("{} {} is above 1: it would reflect more than it receives", name, value));
    color[static_cast<Eigen::Index>(k) - 1] = value;
  }
  // One number stands for three; with two the line ends too early.
  if (lines.words().size() == 3)
    lines.fail_here(fmt::format("{} needs one or three numbers; the line may be truncated", name));
  return lines.words().size() == 2 ? Color(Color::Constant(color[0])) : color;
}

}  // namespace

std::map<std::string, MtlEntry> scan_mtl(const std::string& file, std::string_view text) {
  TextLines lines(file, text);
  std::map<std::string, MtlEntry> entries;
  MtlEntry* entry = nullptr;
  while (lines.next()) {
    const std::string_view keyword = lines.words().front();
    if (keyword == "newmtl") {
      entry = &entries[std::string(lines.remainder())];
      continue;
    }
    if (keyword != "Kd" && keyword != "Ke" && keyword != "map_Kd") continue;
    if (entry == nullptr) lines.fail_here(fmt::format("{} stands before the first newmtl", keyword));
    if (keyword == "map_Kd")
      entry->has_texture = true;
    else if (keyword == "Kd")
      entry->diffuse = read_color(lines, true);
    else
      entry->emission = read_color(lines, false);
  }
  return entries;
}

}  // namespace radiosity

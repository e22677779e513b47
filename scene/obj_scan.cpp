#include "scene/obj_scan.hpp"

#include "foundation/error.hpp"
#include "scene/text_lines.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <map>

namespace radiosity {
namespace {

constexpr std::size_t kMostCorners = 255;  // the parser counts corners in a byte

constexpr std::array<std::string_view, 42> kStatements = {
    "v",     "vt",     "vn",   "vp",     "f",      "fo",       "l",        "p",          "o",
    "g",     "s",      "mg",   "usemtl", "mtllib", "usemap",   "maplib",   "bevel",      "lod",
    "end",   "cstype", "deg",  "bmat",   "step",   "curv",     "curv2",    "surf",       "parm",
    "trim",  "hole",   "scrv", "sp",     "con",    "c_interp", "d_interp", "shadow_obj", "trace_obj",
    "ctech", "stech",  "call", "csh",    "res",    "cdc"};

/// Numbers names in the order of their first use.
class Names {
 public:
  explicit Names(std::vector<std::string>& list) : list_(list) {}

  int number(const std::string& name) {
    const auto [found, is_new] = numbers_.emplace(name, static_cast<int>(list_.size()));
    if (is_new) list_.push_back(name);
    return found->second;
  }

 private:
  std::vector<std::string>& list_;
  std::map<std::string, int> numbers_;
};

class Scanner {
 public:
  Scanner(const std::string& file, std::string_view text)
      : file_(file), lines_(file, text), groups_(scan_.group_names), materials_(scan_.material_names) {}

  ObjScan scan() {
    while (lines_.next()) statement();
    if (forward_index_ > static_cast<std::int64_t>(scan_.vertices.size()))
      fail("{}:{}: vertex {} does not exist; the file has {} vertices", file_, forward_line_, forward_index_,
           scan_.vertices.size());
    return std::move(scan_);
  }

 private:
  void statement() {
    const std::string_view keyword = lines_.words().front();
    if (keyword == "v")
      vertex();
    else if (keyword == "vt")
      ++texture_vertices_;
    else if (keyword == "vn")
      ++normals_;
    else if (keyword == "f")
      face();
    else if (keyword == "g")
      group_ = lines_.remainder();
    else if (keyword == "o")
      object_ = lines_.remainder();
    else if (keyword == "usemtl")
      material_ = lines_.remainder();
    else if (std::find(kStatements.begin(), kStatements.end(), keyword) == kStatements.end() &&
             scan_.unknown_lines++ == 0)
      scan_.first_unknown_line = lines_.number();
  }

  void vertex() {
    if (lines_.words().size() < 4)
      lines_.fail_here("a vertex needs three numbers; the line may be truncated");
    for (std::size_t k = 1; k < lines_.words().size(); ++k) lines_.finite_number(k);
    scan_.vertices.emplace_back(lines_.finite_number(1), lines_.finite_number(2), lines_.finite_number(3));
  }

  void face() {
    const std::size_t corners = lines_.words().size() - 1;
    if (corners < 3)
      lines_.fail_here(fmt::format("a face needs at least three corners, this one has {}", corners));
    if (corners > kMostCorners)
      lines_.fail_here(fmt::format("a face of {} corners is more than the {} that can be read; cut it",
                                   corners, kMostCorners));
    for (std::size_t k = 1; k <= corners; ++k) corner(lines_.words()[k]);
    const std::string& name = !group_.empty() ? group_ : !object_.empty() ? object_ : material_;
    scan_.faces.push_back({groups_.number(name.empty() ? "default" : name), materials_.number(material_)});
  }

  /// v, v/t, v//n or v/t/n; each an index from 1, or from -1 backwards.
  void corner(std::string_view word) {
    const std::array<std::int64_t, 3> counts = {static_cast<std::int64_t>(scan_.vertices.size()),
                                                texture_vertices_, normals_};
    std::string_view rest = word;
    for (std::size_t part = 0; part < 3; ++part) {
      const std::size_t slash = rest.find('/');
      const std::string_view digits = rest.substr(0, slash);
      const bool omitted = digits.empty() && part == 1 && slash != std::string_view::npos;
      if (!omitted) index(digits, word, part, counts[part]);
      if (slash == std::string_view::npos) return;
      rest = rest.substr(slash + 1);
    }
    lines_.fail_here(fmt::format("'{}' is not a corner of a face (v, v/t, v//n or v/t/n)", word));
  }

  void index(std::string_view digits, std::string_view word, std::size_t part, std::int64_t count) {
    std::int64_t value = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || stop != digits.data() + digits.size() || value == 0)
      lines_.fail_here(fmt::format(
          "'{}' is not a corner of a face; indices are whole numbers from 1, or from -1 backwards", word));
    if (value < -count)
      lines_.fail_here(fmt::format("index {} reaches back before the first of {} elements", value, count));
    if (value > INT32_MAX) lines_.fail_here(fmt::format("index {} is too large", value));
    if (part == 0 && value > count && value > forward_index_) {  // may still be defined further down
      forward_index_ = value;
      forward_line_ = lines_.number();
    }
  }

  const std::string& file_;
  TextLines lines_;
  ObjScan scan_;
  Names groups_, materials_;
  std::string group_, object_, material_;
  std::int64_t texture_vertices_ = 0, normals_ = 0;
  std::int64_t forward_index_ = 0;
  std::size_t forward_line_ = 0;
};

}  // namespace

ObjScan scan_obj(const std::string& file, std::string_view text) {
  return Scanner(file, text).scan();
}

}  // namespace radiosity

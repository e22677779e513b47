#include "foundation/error.hpp"
#include "scene/import_formats.hpp"
#include "scene/imported_faces.hpp"
#include "scene/ply_header.hpp"
#include "scene/text_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

// A reader of our own: the library that reads the other formats does not return from truncated PLY files, and
// knows only floats.

namespace radiosity {
namespace {

/// The numbers of the body one after another, from text or from bytes.
class PlyBody {
 public:
  PlyBody(const std::string& file, std::string_view content, const PlyHeader& header)
      : file_(file), content_(content), at_(header.body), header_(header), line_(header.body_line + 1) {}

  double number(PlyScalar type) {
    return header_.format == PlyFormat::ascii ? text_number() : binary_number(type);
  }

  [[noreturn]] void fail_here(const std::string& text) const {
    if (header_.format == PlyFormat::ascii) fail("{}:{}: {}", file_, line_, text);
    fail("{} at byte {}: {}", file_, at_, text);
  }

  std::uint64_t remaining() const { return content_.size() - at_; }

 private:
  double text_number() {
    for (; at_ < content_.size() && is_blank(content_[at_]); ++at_) line_ += content_[at_] == '\n';
    if (at_ == content_.size()) fail_here("the file ends here; it may be truncated");
    std::size_t end = at_;
    while (end < content_.size() && !is_blank(content_[end])) ++end;
    const std::string_view word = content_.substr(at_, end - at_);
    const std::optional<double> value = parse_number(word);
    if (!value) fail_here(fmt::format("'{}' is not a number", word));
    at_ = end;
    return *value;
  }

  static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  double binary_number(PlyScalar type) {
    const std::size_t size = bytes(type);
    if (remaining() < size) fail_here("the file ends here; it may be truncated");
    std::array<char, 8> raw{};
    std::memcpy(raw.data(), content_.data() + at_, size);
    if (header_.format == PlyFormat::big_endian)
      std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(size));
    at_ += size;
    switch (type) {
      case PlyScalar::int8:
        return as<std::int8_t>(raw);
      case PlyScalar::uint8:
        return as<std::uint8_t>(raw);
      case PlyScalar::int16:
        return as<std::int16_t>(raw);
      case PlyScalar::uint16:
        return as<std::uint16_t>(raw);
      case PlyScalar::int32:
        return as<std::int32_t>(raw);
      case PlyScalar::uint32:
        return as<std::uint32_t>(raw);
      case PlyScalar::float32:
        return static_cast<double>(as<float>(raw));
      case PlyScalar::float64:
        return as<double>(raw);
    }
    fail_here("unknown type");
  }

  template <typename T>
  static T as(const std::array<char, 8>& raw) {
    T value;
    std::memcpy(&value, raw.data(), sizeof value);
    return value;
  }

  const std::string& file_;
  std::string_view content_;
  std::size_t at_;
  const PlyHeader& header_;
  std::size_t line_;
};

/// Reads the body element by element.
class PlyReader {
 public:
  PlyReader(const std::string& file, std::string_view content, const std::string& name)
      : file_(file), header_(read_ply_header(file, content)), body_(file, content, header_), faces_(name) {}

  Scene read() {
    faces_.scene().materials.push_back({"default", Color::Constant(0.5), Color::Zero()});
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex")
        vertices(element);
      else if (element.name == "face")
        faces(element);
      else
        skip(element);
    }
    return faces_.finish(file_);
  }

 private:
  void vertices(const PlyElement& element) {
    constexpr std::array<std::string_view, 3> axes = {"x", "y", "z"};
    for (const std::string_view axis : axes)
      if (std::none_of(
              element.properties.begin(), element.properties.end(),
              [&](const PlyProperty& property) { return property.name == axis && !property.is_list; }))
        fail("'{}' has vertices without {}", file_, axis);
    bool colored = false;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      Vector3 point = Vector3::Zero();
      for (const PlyProperty& property : element.properties) {
        const std::vector<double> values = property_values(property);
        const auto axis = std::find(axes.begin(), axes.end(), property.name);
        colored |= property.name == "red";
        if (axis == axes.end()) continue;
        if (!std::isfinite(values.front())) body_.fail_here(fmt::format("vertex {} is not finite", i));
        point[axis - axes.begin()] = values.front();
      }
      faces_.scene().vertices.push_back(point);
    }
    if (colored) faces_.scene().notes.push_back("vertex colours are left out: reflectance 0.5");
  }

  void faces(const PlyElement& element) {
    for (std::uint64_t i = 0; i < element.count; ++i)
      for (const PlyProperty& property : element.properties) {
        const std::vector<double> values = property_values(property);
        if (property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index"))
          face(values, i);
      }
  }

  void face(const std::vector<double>& values, std::uint64_t number) {
    const auto vertex_count = static_cast<double>(faces_.scene().vertices.size());
    if (values.size() < 3)
      body_.fail_here(
          fmt::format("face {} has {} corners; at least three are needed", number, values.size()));
    std::vector<int> corners;
    for (const double value : values) {
      if (!(value >= 0 && value < vertex_count && value == std::floor(value)))
        body_.fail_here(fmt::format("face {} refers to vertex {}; there are {}, numbered from 0", number,
                                    value, vertex_count));
      corners.push_back(static_cast<int>(value));
    }
    faces_.polygon(corners, 0, faces_.group("default"));
  }

  void skip(const PlyElement& element) {
    if (element.properties.empty()) return;
    for (std::uint64_t i = 0; i < element.count; ++i)
      for (const PlyProperty& property : element.properties) property_values(property);
  }

  std::vector<double> property_values(const PlyProperty& property) {
    if (!property.is_list) return {body_.number(property.type)};
    const double count = body_.number(property.count_type);
    if (!(count >= 0 && count == std::floor(count)))
      body_.fail_here(fmt::format("a list cannot have {} entries", count));
    if (count > static_cast<double>(body_.remaining()))
      body_.fail_here(
          fmt::format("a list of {} entries is announced, but the file ends; it may be truncated", count));
    std::vector<double> values;
    for (auto k = static_cast<std::uint64_t>(count); k > 0; --k)
      values.push_back(body_.number(property.type));
    return values;
  }

  const std::string& file_;
  PlyHeader header_;
  PlyBody body_;
  ImportedFaces faces_;
};

}  // namespace

Scene import_ply(const std::filesystem::path& path) {
  const std::string file = path.string();
  const std::string content = read_text(file);
  return PlyReader(file, content, path.stem().string()).read();
}

}  // namespace radiosity

#include "render/glb_export.hpp"

#include "foundation/error.hpp"
#include "foundation/output_file.hpp"
#include "render/bounding_box.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace radiosity {
namespace {

using nlohmann::json;

// Constants of the glTF 2.0 specification (sections 3.6.2, 4.4).
constexpr int component_float = 5126;
constexpr int component_unsigned_int = 5125;
constexpr int target_array_buffer = 34962;
constexpr int target_element_array_buffer = 34963;
constexpr std::uint32_t glb_magic = 0x46546C67;
constexpr std::uint32_t chunk_json = 0x4E4F534A;
constexpr std::uint32_t chunk_binary = 0x004E4942;

using Float3 = std::array<float, 3>;

struct Buffers {
  Vector3 centre = Vector3::Zero();
  std::vector<Float3> positions;
  std::vector<Float3> colors;
  std::vector<Float3> radiosities;
  std::vector<std::uint32_t> indices;
};

Buffers fill_buffers(const PatchMesh& mesh, const Eigen::MatrixXd& B, double exposure) {
  Buffers buffers;
  buffers.centre = bounding_box(mesh).center();
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    Float3 color;
    Float3 value;
    for (Index c = 0; c < 3; ++c) {
      const double radiosity = B(i, B.cols() == 3 ? c : 0);
      const auto at = static_cast<std::size_t>(c);
      color[at] = static_cast<float>(std::clamp(exposure * radiosity / std::numbers::pi, 0.0, 1.0));
      value[at] = static_cast<float>(radiosity);
    }
    const auto first = static_cast<std::uint32_t>(buffers.positions.size());
    const int corners = mesh.patches[static_cast<std::size_t>(i)].corner_count;
    for (int k = 0; k < corners; ++k) {
      const Vector3 p = mesh.corner(i, k) - buffers.centre;
      buffers.positions.push_back(
          {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
      buffers.colors.push_back(color);
      buffers.radiosities.push_back(value);
    }
    for (std::uint32_t k = 2; k < static_cast<std::uint32_t>(corners); ++k)
      buffers.indices.insert(buffers.indices.end(), {first, first + k - 1, first + k});
  }
  return buffers;
}

/// The binary chunk and the views into it that the JSON lists. Every view is a multiple of 4 bytes, as glTF
/// wants.
class BinaryChunk {
 public:
  template <typename T>
  int add(const std::vector<T>& values, int target) {
    const std::size_t length = values.size() * sizeof(T);
    views_.push_back(
        json{{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", length}, {"target", target}});
    const std::size_t offset = bytes_.size();
    bytes_.resize(offset + length);
    std::memcpy(bytes_.data() + offset, values.data(), length);
    return static_cast<int>(views_.size()) - 1;
  }
  const std::vector<char>& bytes() const { return bytes_; }
  const json& views() const { return views_; }

 private:
  std::vector<char> bytes_;
  json views_ = json::array();
};

json component_bounds(const std::vector<Float3>& values, bool upper) {
  Float3 bound = values.front();
  for (const Float3& value : values)
    for (std::size_t c = 0; c < 3; ++c)
      bound[c] = upper ? std::max(bound[c], value[c]) : std::min(bound[c], value[c]);
  return bound;
}

json describe(const Buffers& buffers, const std::string& name, double exposure, BinaryChunk& binary) {
  const auto vectors = [&](const std::vector<Float3>& values) {
    return json{{"bufferView", binary.add(values, target_array_buffer)},
                {"componentType", component_float},
                {"count", values.size()},
                {"type", "VEC3"},
                {"min", component_bounds(values, false)},
                {"max", component_bounds(values, true)}};
  };
  json accessors = json::array();
  for (const auto* values : {&buffers.positions, &buffers.colors, &buffers.radiosities})
    accessors.push_back(vectors(*values));
  accessors.push_back(json{{"bufferView", binary.add(buffers.indices, target_element_array_buffer)},
                           {"componentType", component_unsigned_int},
                           {"count", buffers.indices.size()},
                           {"type", "SCALAR"}});
  const json primitive = {{"attributes", {{"POSITION", 0}, {"COLOR_0", 1}, {"_RADIOSITY", 2}}},
                          {"indices", 3},
                          {"material", 0},
                          {"mode", 4}};
  const json material = {{"name", "radiosity"},
                         {"pbrMetallicRoughness",
                          {{"baseColorFactor", {1, 1, 1, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}},
                         {"extensions", {{"KHR_materials_unlit", json::object()}}}};
  const Vector3& centre = buffers.centre;
  const json node = {{"name", name}, {"mesh", 0}, {"translation", {centre.x(), centre.y(), centre.z()}}};
  json document;
  document["asset"] = {{"version", "2.0"},
                       {"generator", "radiosity"},
                       {"extras", {{"exposure", exposure}, {"radiosity_unit", "W/m^2"}}}};
  document["extensionsUsed"] = json::array({"KHR_materials_unlit"});
  document["scene"] = 0;
  document["scenes"] = json::array({{{"nodes", json::array({0})}}});
  document["nodes"] = json::array({node});
  document["meshes"] = json::array({{{"name", name}, {"primitives", json::array({primitive})}}});
  document["materials"] = json::array({material});
  document["accessors"] = accessors;
  document["bufferViews"] = binary.views();
  document["buffers"] = json::array({{{"byteLength", binary.bytes().size()}}});
  return document;
}

void write_word(std::ostream& stream, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) stream.put(static_cast<char>((word >> shift) & 0xff));
}

}  // namespace

void write_glb(const std::filesystem::path& file, const PatchMesh& mesh, const Eigen::MatrixXd& B,
               double exposure) {
  if (mesh.patch_count() == 0)
    fail("cannot write '{}': the scene has no patches, and glTF needs some", file.string());
  const std::string name = mesh.scene && !mesh.scene->name.empty() ? mesh.scene->name : "scene";
  BinaryChunk binary;
  const Buffers buffers = fill_buffers(mesh, B, exposure);
  std::string text =
      describe(buffers, name, exposure, binary).dump(-1, ' ', false, json::error_handler_t::replace);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::size_t size = 12 + 8 + text.size() + 8 + binary.bytes().size();
  if (size > std::numeric_limits<std::uint32_t>::max())
    fail("cannot write '{}': {} patches pass the 4 GiB of binary glTF; write .ply instead", file.string(),
         mesh.patch_count());

  OutputFile output(file);
  std::ostream& stream = output.stream();
  write_word(stream, glb_magic);
  write_word(stream, 2);
  write_word(stream, static_cast<std::uint32_t>(size));
  write_word(stream, static_cast<std::uint32_t>(text.size()));
  write_word(stream, chunk_json);
  stream << text;
  write_word(stream, static_cast<std::uint32_t>(binary.bytes().size()));
  write_word(stream, chunk_binary);
  stream.write(binary.bytes().data(), static_cast<std::streamsize>(binary.bytes().size()));
  output.commit();
}

}  // namespace radiosity

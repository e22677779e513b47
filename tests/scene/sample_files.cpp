#include "sample_files.hpp"

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace {

template <typename T>
void append(std::string& text, T value) {
  std::array<char, sizeof(T)> bytes{};
  std::memcpy(bytes.data(), &value, sizeof(T));
  text.append(bytes.data(), bytes.size());
}

const std::array<std::array<float, 3>, 4> kSquare = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};

// Positions of the square, then the indices of its two triangles.
std::string gltf_buffer() {
  std::string buffer;
  for (const auto& point : kSquare)
    for (const float value : point) append(buffer, value);
  for (const int index : {0, 1, 2, 0, 2, 3}) append(buffer, static_cast<std::uint16_t>(index));
  return buffer;
}

// The node is moved by 5 along z.
std::string gltf_json(const std::string& buffer) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
         R"("nodes":[{"name":"panel","mesh":0,"translation":[0,0,5]}],)"
         R"("meshes":[{"name":"square","primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],)"
         R"("materials":[{"name":"lamp","pbrMetallicRoughness":{"baseColorFactor":[0.25,0.5,0.75,1]},)"
         R"("emissiveFactor":[1,0.5,0]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},)"
         R"({"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],)"
         R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],)"
         R"("buffers":[{)" +
         buffer + R"("byteLength":60}]})";
}

std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) {  // 60 bytes: no padding
    const auto byte = [&](std::size_t k) {
      return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i + k]));
    };
    const std::uint32_t word = byte(0) << 16U | byte(1) << 8U | byte(2);
    for (int shift = 18; shift >= 0; shift -= 6) text.push_back(digits[(word >> shift) & 63U]);
  }
  return text;
}

}  // namespace

std::string sample_obj() {
  return "# a quad and a triangle\n"
         "mtllib sample.mtl\n"
         "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\n"
         "v 0 0 1.5e0\n"
         "g floor\nusemtl paint\nf 1 2 3 4\n"
         "g lamp\nusemtl glow\nf -5/1/1 2//1 5/1\n";
}

std::string sample_mtl() {
  return "newmtl paint\nKd 0.2 0.4 0.6\n\nnewmtl glow\nKd 0.5 0.5 0.5\nKe 1 2 3\n";
}

std::string sample_ascii_ply() {
  return "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n4 0 1 2 3\n3 0 1 4\n";
}

std::string sample_binary_ply() {
  std::string file =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
      "float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& point : kSquare)
    for (const float value : point) append(file, value);
  for (const std::array<int, 3>& triangle : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
    append(file, std::uint8_t{3});
    for (const int index : triangle) append(file, static_cast<std::int32_t>(index));
  }
  return file;
}

std::string sample_ascii_stl() {
  return "solid sheet\n"
         "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n"
         "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\n"
         "endsolid sheet\n";
}

std::string sample_binary_stl() {
  std::string file(80, ' ');
  append(file, std::uint32_t{2});
  for (const std::array<std::size_t, 3>& triangle : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 3}}) {
    for (const float value : {0.0F, 0.0F, 1.0F}) append(file, value);
    for (const std::size_t corner : triangle)
      for (const float value : kSquare[corner]) append(file, value);
    append(file, std::uint16_t{0});
  }
  return file;
}

std::string sample_gltf() {
  return gltf_json(R"("uri":"data:application/octet-stream;base64,)" + base64(gltf_buffer()) + R"(",)");
}

std::string sample_glb() {
  std::string json = gltf_json("");
  json.append((4 - json.size() % 4) % 4, ' ');
  const std::string buffer = gltf_buffer();
  std::string file = "glTF";
  append(file, std::uint32_t{2});
  append(file, static_cast<std::uint32_t>(28 + json.size() + buffer.size()));
  append(file, static_cast<std::uint32_t>(json.size()));
  file += "JSON" + json;
  append(file, static_cast<std::uint32_t>(buffer.size()));
  file += std::string("BIN\0", 4) + buffer;
  return file;
}

#include "foundation/error.hpp"
#include "scene/import_checks.hpp"
#include "scene/import_formats.hpp"
#include "scene/imported_faces.hpp"
#include "scene/text_lines.hpp"

#include <assimp/Importer.hpp>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <numbers>

namespace radiosity {
namespace {

Color color_of(const aiColor3D& color) {
  return {color.r, color.g, color.b};
}

/// Turns what the library read into a Scene: nodes and their meshes one after another, transforms applied.
class Converter {
 public:
  Converter(const aiScene& source, std::string file, const std::string& name)
      : source_(source), file_(std::move(file)), faces_(name), material_numbers_(source.mNumMaterials, -1) {}

  Scene convert() {
    if (source_.mRootNode != nullptr) node(*source_.mRootNode, aiMatrix4x4(), 0);
    if (skipped_ > 0)
      scene().notes.push_back(fmt::format("{} points and lines left out: only faces are lit", skipped_));
    if (textured_) scene().notes.push_back("textures are left out: the base colours count");
    if (vertex_colors_) scene().notes.push_back("vertex colours are left out: the material's colour counts");
    return faces_.finish(file_);
  }

 private:
  Scene& scene() { return faces_.scene(); }

  void node(const aiNode& current, const aiMatrix4x4& parent, int depth) {
    if (depth > 1000) fail("'{}' has nodes nested more than 1000 deep", file_);
    const aiMatrix4x4 transform = parent * current.mTransformation;
    for (unsigned i = 0; i < current.mNumMeshes; ++i) {
      if (current.mMeshes[i] >= source_.mNumMeshes)
        fail("'{}' refers to mesh {}, which does not exist", file_, current.mMeshes[i]);
      mesh(*source_.mMeshes[current.mMeshes[i]], transform, current.mName.C_Str());
    }
    for (unsigned i = 0; i < current.mNumChildren; ++i) node(*current.mChildren[i], transform, depth + 1);
  }

  void mesh(const aiMesh& source, const aiMatrix4x4& transform, const std::string& node_name) {
    const auto first = static_cast<int>(scene().vertices.size());
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
      const aiVector3D point = transform * source.mVertices[i];
      scene().vertices.emplace_back(point.x, point.y, point.z);
      if (!scene().vertices.back().allFinite())
        fail("'{}' has a vertex that is not finite: vertex {} of mesh '{}'", file_, i, source.mName.C_Str());
    }
    vertex_colors_ |= source.HasVertexColors(0);
    const std::string group = !node_name.empty() ? node_name : source.mName.C_Str();
    // A transform that mirrors would turn fronts into backs.
    const bool mirrored = transform.Determinant() < 0;
    for (unsigned i = 0; i < source.mNumFaces; ++i) face(source, i, first, mirrored, group);
  }

  void face(const aiMesh& source, unsigned number, int first, bool mirrored, const std::string& group) {
    const aiFace& face = source.mFaces[number];
    if (face.mNumIndices < 3) {
      ++skipped_;
      return;
    }
    std::vector<int> corners;
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      if (face.mIndices[k] >= source.mNumVertices)
        fail("'{}': face {} of mesh '{}' refers to vertex {}, but there are {}", file_, number,
             source.mName.C_Str(), face.mIndices[k], source.mNumVertices);
      corners.push_back(first + static_cast<int>(face.mIndices[k]));
    }
    if (mirrored) std::reverse(corners.begin(), corners.end());
    const int used = material(source.mMaterialIndex);
    const std::string& fallback = scene().materials[static_cast<std::size_t>(used)].name;
    faces_.polygon(corners, used, faces_.group(group.empty() ? fallback : group));
  }

  /// Index into the scene's materials, added where a face first uses it.
  int material(unsigned number) {
    if (number >= source_.mNumMaterials)
      fail("'{}' refers to material {}, which does not exist", file_, number);
    int& index = material_numbers_[number];
    if (index >= 0) return index;
    index = static_cast<int>(scene().materials.size());
    scene().materials.push_back(convert(*source_.mMaterials[number]));
    return index;
  }

  Material convert(const aiMaterial& source) {
    Material result;
    const std::string name = source.GetName().C_Str();
    result.name = name.empty() ? "default" : name;
    aiColor4D base;
    aiColor3D diffuse, emissive;
    if (source.Get(AI_MATKEY_BASE_COLOR, base) == aiReturn_SUCCESS)
      result.reflectance = {base.r, base.g, base.b};
    else if (name != AI_DEFAULT_MATERIAL_NAME &&
             source.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse) == aiReturn_SUCCESS)
      result.reflectance = color_of(diffuse);
    float strength = 1;
    if (source.Get(AI_MATKEY_COLOR_EMISSIVE, emissive) == aiReturn_SUCCESS) {
      source.Get(AI_MATKEY_EMISSIVE_INTENSITY, strength);
      result.emission = std::numbers::pi * strength * color_of(emissive);
    }
    textured_ |= source.GetTextureCount(aiTextureType_DIFFUSE) > 0 ||
                 source.GetTextureCount(aiTextureType_BASE_COLOR) > 0;
    check(result);
    return result;
  }

  void check(const Material& material) const {
    for (int k = 0; k < 3; ++k) {
      if (!(material.reflectance[k] >= 0 && material.reflectance[k] <= 1))
        fail("'{}': material '{}' has reflectance {}; it must be from 0 to 1", file_, material.name,
             material.reflectance[k]);
      if (!(material.emission[k] >= 0 && material.emission[k] < 1e30))
        fail("'{}': material '{}' has emission {}; it must be 0 or more", file_, material.name,
             material.emission[k]);
    }
  }

  const aiScene& source_;
  std::string file_;
  ImportedFaces faces_;
  std::vector<int> material_numbers_;
  std::size_t skipped_ = 0;
  bool textured_ = false;
  bool vertex_colors_ = false;
};

void check_before_reading(const std::string& file, const std::string& extension) {
  const std::string content = read_text(file);
  if (extension == ".glb") check_glb(file, content);
}

}  // namespace

Scene import_with_assimp(const std::filesystem::path& path) {
  const std::string file = path.string();
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  check_before_reading(file, extension);
  Assimp::Importer importer;
  const aiScene* source = nullptr;
  try {
    source = importer.ReadFile(file, aiProcess_ValidateDataStructure);
  } catch (const std::exception& error) {
    fail("'{}' cannot be read: {}", file, error.what());
  }
  if (source == nullptr || (source->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0)
    fail("'{}' cannot be read: {}", file, importer.GetErrorString());
  return Converter(*source, file, path.stem().string()).convert();
}

}  // namespace radiosity

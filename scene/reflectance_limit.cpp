#include "foundation/error.hpp"
#include "scene/patch_mesh.hpp"

#include <cmath>
#include <set>

namespace radiosity {
namespace {

std::string material_name(const PatchMesh& mesh, Index patch) {
  const int material = mesh.patches[static_cast<std::size_t>(patch)].material;
  return mesh.scene->materials[static_cast<std::size_t>(material)].name;
}

}  // namespace

void limit_reflectance(PatchMesh& mesh, double limit) {
  if (!(limit >= 0 && limit < 1))
    fail<UsageError>("a reflectance limit of {} is not possible; give one from 0 to below 1", limit);
  std::set<std::string> limited;
  for (Index i = 0; i < mesh.patch_count(); ++i) {
    const double largest = mesh.reflectance.row(i).maxCoeff();
    if (limit == 0) {
      if (!(largest < 1))
        fail(
            "patch {} of material '{}' has reflectance {}, and radiosity needs less than 1; pass "
            "--max-reflectance, 0.99 for example",
            i, material_name(mesh, i), largest);
    } else if (largest > limit) {
      mesh.reflectance.row(i) *= limit / largest;
      limited.insert(material_name(mesh, i));
    }
  }
  for (const std::string& name : limited)
    mesh.notes.push_back(fmt::format("reflectance of material '{}' scaled down to at most {}", name, limit));
}

}  // namespace radiosity

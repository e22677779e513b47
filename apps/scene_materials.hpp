#pragma once

#include "scene/patch_mesh.hpp"

#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// What the command line says about reflectance and emission; later members win over earlier ones.
struct MaterialSettings {
  std::optional<double> reflectance;  ///< of every patch, [0, 1]
  std::string emission_file;          ///< .npy, n x 1 or n x 3, W/m^2; empty: none
  std::vector<std::string>
      group_settings;  ///< "GROUP:reflectance=R,emission=E", one number or three with '/' between
};

/// Replaces reflectance and emission of the patches. The mesh has one channel afterwards if everything is
/// grey, else three. Throws UsageError for settings that cannot be read, unknown groups and keys, and values
/// out of range (reflectance [0, 1], emission >= 0); Error for an emission file that cannot be read or has a
/// wrong shape.
void apply_materials(PatchMesh& mesh, const MaterialSettings& settings);

}  // namespace radiosity

#pragma once

#include "foundation/stopwatch.hpp"
#include "scene/voxel_simplification.hpp"

#include <memory>
#include <optional>
#include <string>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace radiosity {

/// What `--simplify` did (key "simplification" of the JSON).
struct SimplificationSummary {
  std::size_t triangles = 0;  ///< of the original faces
  Index original_patches = 0;
  Index patches = 0;
  Vector3 cell = Vector3::Zero();  ///< sides, in scene units
  double seconds = 0;
  double transfer_seconds = 0;  ///< to pull the light back to the patches
};

/// Registers `--simplify voxels:N`.
CLI::Option* add_simplify_option(CLI::App& command, std::optional<std::string>& text);

/// N of "voxels:N", or nothing where nothing is asked for. Throws UsageError for anything else.
std::optional<Index> wanted_voxels(const std::optional<std::string>& option);

/// A scene simplified in the light of an emission, and the light that was found on it pulled back.
class Simplification {
 public:
  /// `emission` is n x channels, W/m^2, on the patches of the original.
  Simplification(const PatchMesh& original, const Eigen::MatrixXd& emission, Index voxels);

  const std::shared_ptr<const PatchMesh>& mesh() const { return simplified_.mesh; }
  const SimplificationSummary& summary() const { return summary_; }

  /// B of the original patches from the irradiance H of the quads.
  Eigen::MatrixXd patches(const Eigen::MatrixXd& irradiance);

  /// The same at their corners, 4 n x channels.
  Eigen::MatrixXd corners(const Eigen::MatrixXd& irradiance) const;

  /// One sentence about it.
  std::string note() const;

 private:
  PatchMesh lit_;    // the original with the emission
  Stopwatch watch_;  // begins before the next member
  SimplifiedScene simplified_;
  SimplificationSummary summary_;
};

}  // namespace radiosity

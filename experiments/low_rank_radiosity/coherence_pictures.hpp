#pragma once

#include "experiments/low_rank_radiosity/neighbour_rows.hpp"
#include "experiments/report.hpp"
#include "form_factors/form_factors.hpp"
#include "foundation/monitor.hpp"
#include "operators/linear_operator.hpp"
#include "scene/coarse_mesh.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace radiosity {

struct CoherencePictureOptions {
  std::string scene = "cornell-box-closed";
  Index view_patches = 1000;   ///< of the mesh that scene views and rows of F are shown on
  Index fine_patches = 3300;   ///< of the fine mesh and of the coherence map
  Index coarse_patches = 206;  ///< k
  int directions = 1024;       ///< of a scene view
  int picture_size = 420;      ///< pixels each way
  std::uint64_t seed = 1;
};

/// What the pictures of document 004, Figures 1 and 2, show.
struct CoherenceMeasurement {
  FormFactors form_factors;          ///< of the mesh with view_patches
  Field radiosity;                   ///< its solution for the scene's own light
  std::vector<NeighbourPair> pairs;  ///< by rising row difference
  std::shared_ptr<const PatchMesh> fine;
  Eigen::VectorXd incoherence;  ///< of each patch of `fine`, 0 to 1 (form_factors/scene_views.hpp)
  PatchMesh largest;            ///< the patches that Algorithm 1 starts with: the faces
  CoarseMesh coarse;            ///< its k patches, with those of `fine` as elements

  /// Half of all pairs have rows that differ less than this one's; the one whose rows differ most.
  const NeighbourPair& typical_pair() const { return pairs[pairs.size() / 2]; }
  const NeighbourPair& extreme_pair() const { return pairs.back(); }
  /// The k-th patch of `fine` lies in a coarse patch of this area: m^2, n.
  Eigen::VectorXd area_of_coarse_patch() const;
};

/// Throws UsageError for a scene that has more faces than coarse_patches or no two patches on any face, Error
/// where the radiosity does not exist.
CoherenceMeasurement measure_coherence(const CoherencePictureOptions& options, Monitor& monitor);

/// The PNG files of the section: one a figure.
struct CoherenceFiles {
  std::filesystem::path typical_views, extreme_views, coherence, meshes;
};

/// The figures with their captions, all numbers taken from the measurement.
ReportSection coherence_section(const CoherenceMeasurement& measurement, const CoherenceFiles& files,
                                const std::string& command);

/// Scene views of two close patches beside their rows of F, coherence map, and the meshes of 2MSC. Writes
/// low_rank_views.png, low_rank_views_extreme.png, low_rank_coherence.png, low_rank_meshes.png and
/// low_rank_pictures.json into `folder` (made if it is missing), returns the section.
ReportSection low_rank_pictures(const std::filesystem::path& folder, const std::string& command,
                                const CoherencePictureOptions& options, Monitor& monitor);

}  // namespace radiosity

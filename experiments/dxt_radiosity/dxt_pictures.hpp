#pragma once

#include "compression/colour_compression.hpp"
#include "compression/dds_file.hpp"
#include "experiments/report.hpp"
#include "foundation/monitor.hpp"
#include "operators/operator_registry.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace radiosity {

/// Pictures of document 000's matrix, a pixel an entry, and of what it lights.
struct DxtPicturesOptions {
  std::string scene = "cornell-box-closed";
  Index patches = 400;
  long bounces = 3;
  int difference_gain = 4;  ///< times which differences of codes are drawn
  double light_gain = 10;   ///< times which differences in radiosity are drawn
  int picture_size = 360;   ///< pixels each way of the lit scene
  std::uint64_t seed = 1;
};

/// Codes of the three channels, n x n: what the document's figures show.
using CodePicture = std::array<CodeMatrix, 3>;

struct MatrixPictures {
  CodePicture before;      ///< Figure 5: in the order of faces
  CodePicture reordered;   ///< the same by rows and columns
  CodePicture compressed;  ///< Figure 8
  BlockTexture<Bc1Block> texture;

  /// Figure 10: |compressed - reordered|.
  CodePicture difference() const;
};

/// Throws UsageError unless there are three matrices.
MatrixPictures matrix_pictures(const std::vector<ColourMatrix>& matrices, const PatchMesh& mesh);

/// The blocks of a texture without those that pad its rows.
BlockTexture<Bc1Block> block_texture(const ColourTexture& texture);

/// Writes dxt_order.png, dxt_compressed.png, dxt_difference.png, dxt_lit.png,
/// dxt_texture.dds and dxt_pictures.json into `folder` (made if it is missing), returns the section.
ReportSection dxt_pictures(const std::filesystem::path& folder, const std::string& command,
                           const DxtPicturesOptions& options, const OperatorRegistry& operators,
                           Monitor& monitor);

}  // namespace radiosity

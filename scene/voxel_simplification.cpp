#include "scene/voxel_simplification.hpp"

#include "foundation/error.hpp"
#include "scene/scene_builder.hpp"
#include "scene/voxel_quads.hpp"

#include <cmath>
#include <utility>

namespace radiosity {
namespace {

Eigen::AlignedBox3d box_of_patches(const PatchMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (Index i = 0; i < mesh.patch_count(); ++i)
    for (int k = 0; k < mesh.patches[static_cast<std::size_t>(i)].corner_count; ++k)
      box.extend(mesh.corner(i, k));
  return box;
}

/// A grid and what a mesh has in it.
struct GridTrial {
  double edge;
  VoxelGrid grid;
  Index quads;
};

/// Finds the grid with the wanted number of quads.
class GridSearch {
 public:
  GridSearch(const PatchMesh& mesh, Index wanted)
      : mesh_(mesh), wanted_(wanted), box_(box_of_patches(mesh)) {}

  VoxelGrid nearest() const {
    auto [coarse, fine] = bracket();
    while (coarse.quads < wanted_ && fine.quads > wanted_ && coarse.edge > fine.edge * (1 + 1e-6)) {
      const double edge = std::sqrt(coarse.edge * fine.edge);
      const VoxelGrid grid(box_, edge);
      if (grid == coarse.grid) {
        coarse.edge = edge;
      } else if (grid == fine.grid) {
        fine.edge = edge;
      } else {
        GridTrial between = trial(edge);
        (between.quads <= wanted_ ? coarse : fine) = std::move(between);
      }
    }
    return std::abs(coarse.quads - wanted_) <= std::abs(fine.quads - wanted_) ? coarse.grid : fine.grid;
  }

 private:
  GridTrial trial(double edge) const {
    const VoxelGrid grid(box_, edge);
    return {edge, grid, count_quads(cut_into_voxels(mesh_, grid))};
  }

  bool has_one_cell(const GridTrial& found) const { return (found.grid.counts() == 1).all(); }

  /// Two grids with fewer and more quads than wanted, or the wanted number.
  std::pair<GridTrial, GridTrial> bracket() const {
    // As if every quad filled a face of its cell.
    GridTrial coarse = trial(std::sqrt(mesh_.area.sum() / static_cast<double>(wanted_)));
    GridTrial fine = coarse;
    while (coarse.quads > wanted_ && !has_one_cell(coarse)) {
      fine = coarse;
      coarse = trial(1.5 * coarse.edge);
    }
    while (fine.quads < wanted_) {
      coarse = fine;
      fine = trial(fine.edge / 1.5);
    }
    return {coarse, fine};
  }

  const PatchMesh& mesh_;
  Index wanted_;
  Eigen::AlignedBox3d box_;
};

Color as_color(const Eigen::RowVectorXd& channels) {
  return channels.size() == 3 ? Color(channels.transpose().array()) : Color::Constant(channels[0]);
}

/// One face and one material a quad.
Scene scene_of(const std::vector<VoxelQuad>& quads, const Scene& original) {
  SceneBuilder builder(original.name + " (voxels)");
  builder.scene().groups = original.groups;
  builder.scene().camera = original.camera;
  builder.scene().contacts = Contacts::never;
  for (const VoxelQuad& quad : quads) {
    const int material = builder.material({"voxel", as_color(quad.reflectance), as_color(quad.emission)});
    builder.face(quad.corners, material, quad.group);
  }
  return std::move(builder.scene());
}

}  // namespace

SimplifiedScene simplify_to_voxels(const PatchMesh& mesh, const VoxelGrid& grid) {
  std::vector<VoxelFragment> fragments = cut_into_voxels(mesh, grid);
  const std::vector<VoxelQuad> quads = voxel_quads(mesh, grid, fragments);
  auto simplified = std::make_shared<PatchMesh>(make_patches(scene_of(quads, *mesh.scene)));
  // Colours whose means happen to be grey keep the channels of the original.
  simplified->reflectance.resize(simplified->patch_count(), mesh.channels());
  simplified->emission.resize(simplified->patch_count(), mesh.channels());
  for (Index i = 0; i < simplified->patch_count(); ++i) {
    const auto face = static_cast<std::size_t>(simplified->patches[static_cast<std::size_t>(i)].face);
    simplified->reflectance.row(i) = quads[face].reflectance;
    simplified->emission.row(i) = quads[face].emission;
  }
  // Gaps between voxels are no windows.
  simplified->topology.enclosure = simplified->topology.enclosure || mesh.topology.enclosure;
  return {std::move(simplified), grid, std::move(fragments)};
}

SimplifiedScene simplify_to_voxels(const PatchMesh& mesh, Index wanted) {
  if (wanted < 1) fail<UsageError>("a scene cannot be simplified to {} patches: 1 is the least", wanted);
  return simplify_to_voxels(mesh, GridSearch(mesh, wanted).nearest());
}

}  // namespace radiosity

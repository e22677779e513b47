// A mesh library that had no part in writing the PLY reads it (positions in single precision).
#include "render/tone_mapping.hpp"
#include "render/write_solution.hpp"
#include "tests/render/rooms.hpp"
#include "tests/temporary_folder.hpp"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

namespace radiosity {
namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Color);
};
using DoubleMesh = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;

TEST(PlyExport, OpensInOpenMesh) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "mesh.ply";
  const PatchMesh mesh = make_patches(test::box_room({1, 2, 3}), {.patches = 54});
  const Eigen::MatrixXd B = Eigen::VectorXd::LinSpaced(mesh.patch_count(), 1, 2);
  SilentMonitor monitor;
  write_solution(file, mesh, B, {}, monitor);

  DoubleMesh read;
  OpenMesh::IO::Options options = OpenMesh::IO::Options::VertexColor;
  ASSERT_TRUE(OpenMesh::IO::read_mesh(read, file.string(), options));
  ASSERT_EQ(read.n_faces(), mesh.patches.size());
  EXPECT_TRUE(options.vertex_has_color());
  std::size_t i = 0;
  for (const DoubleMesh::FaceHandle face : read.faces()) {
    const auto patch = static_cast<Index>(i++);
    const OpenMesh::Vec3d center = read.calc_face_centroid(face);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(center[static_cast<std::size_t>(axis)], mesh.centroid(axis, patch), 1e-6);
    int corner = 0;
    for (const DoubleMesh::VertexHandle vertex : read.fv_range(face)) {
      EXPECT_EQ(read.color(vertex)[0], read.color(*read.fv_begin(face))[0]);
      ++corner;
    }
    EXPECT_EQ(corner, 4);
  }
  // From dark to bright, as B is.
  const auto color_of = [&](unsigned face) { return read.color(*read.fv_begin(read.face_handle(face)))[0]; };
  EXPECT_LT(color_of(0), color_of(static_cast<unsigned>(read.n_faces()) - 1));
}

}  // namespace
}  // namespace radiosity

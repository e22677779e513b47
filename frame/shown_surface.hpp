#pragma once

#include "frame/frame_mesh.hpp"
#include "gpu/gl_buffer.hpp"
#include "gpu/gl_device.hpp"
#include "gpu/gl_name.hpp"
#include "gpu/resident_transport.hpp"

#include <memory>

namespace radiosity {

/// What the camera sees, on the device: triangles with the material of their patch and the indirect light of
/// their vertices. The context is current in every call.
class ShownSurface {
 public:
  /// `shown` is the mesh whose patches the triangles of `mesh` are. Throws Error where they do not fit into a
  /// storage block.
  ShownSurface(const std::shared_ptr<GlDevice>& device, const FrameMesh& mesh, const PatchMesh& shown,
               const Vector3& origin);

  /// Document 000, section 3.6, step 4: indirect light of the vertices, by a compute shader. A memory barrier
  /// comes before draw().
  void gather(const ResidentTransport& transport) const;
  /// Step 5, into the framebuffer that is bound; shadow maps and the frame's block are bound too.
  void draw() const;

 private:
  Index vertex_count_;
  int index_count_;
  GlBuffer positions_, indices_, light_;
  GlBuffer gather_begin_, gather_patch_, gather_weight_;
  GlBuffer patch_of_triangle_, surfaces_;
  GlName vertices_;
  const GlProgram* gather_program_;  ///< the device's
  GlProgram draw_program_;
};

}  // namespace radiosity

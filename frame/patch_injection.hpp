#pragma once

#include "frame/emission_points.hpp"
#include "frame/frame_block.hpp"
#include "gpu/gl_buffer.hpp"
#include "gpu/gl_device.hpp"
#include "gpu/gl_name.hpp"
#include "gpu/resident_transport.hpp"

#include <memory>
#include <vector>

namespace radiosity {

/// The emission of patches from pictures of them around each light, a cube of 128 x 128 pixels a face, each
/// of which adds its part of the light's power to the patch that it shows (document 001). No power is lost or
/// made, whatever the size of patches; what is smaller than a pixel gets all of it or nothing. The patches
/// themselves block light, backs take what arrives there. The context is current in every call.
class PatchInjection {
 public:
  static constexpr int face_pixels = 128;

  /// Throws Error where the patches do not fit into a storage block.
  PatchInjection(const std::shared_ptr<GlDevice>& device, const PatchMesh& mesh,
                 const std::vector<FrameLightKind>& lights, const Vector3& origin);

  /// Writes the transport's emission; the frame's block is bound.
  void compute(const ResidentTransport& transport) const;

 private:
  void draw_around(std::size_t light) const;
  void sum_up(std::size_t light) const;

  std::vector<FrameLightKind> kinds_;
  Index patches_;
  int corners_;
  GlProgram cube_program_, spot_program_;
  const GlProgram* sums_program_;      ///< the device's
  const GlProgram* emission_program_;  ///< the device's
  GlBuffer positions_, patch_of_triangle_, sums_, reflectance_, own_, areas_;
  GlName vertices_, triangles_, depth_, framebuffer_;
};

}  // namespace radiosity

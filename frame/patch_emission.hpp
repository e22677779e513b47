#pragma once

#include "frame/emission_points.hpp"
#include "gpu/gl_buffer.hpp"
#include "gpu/gl_device.hpp"
#include "gpu/resident_transport.hpp"

#include <memory>

namespace radiosity {

/// The emission of patches from shadow maps, by a compute shader (document 000, section 3.6, step 2). The
/// context is current in every call.
class PatchEmission {
 public:
  /// Throws Error where the points do not fit into a storage block.
  PatchEmission(const std::shared_ptr<GlDevice>& device, const EmissionPoints& points, const Vector3& origin);

  /// Writes the transport's emission; shadow maps and the frame's block are bound.
  void compute(const ResidentTransport& transport) const;

 private:
  Index patches_;
  Index points_of_patch_;
  int lanes_;
  const GlProgram* program_;  ///< the device's
  GlBuffer points_, reflectance_, own_;
};

}  // namespace radiosity

#pragma once

#include "gpu/field_buffers.hpp"
#include "gpu/gl_program.hpp"
#include "gpu/gl_timer.hpp"
#include "gpu/texel_units.hpp"
#include "gpu/texture_palettes.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace radiosity {

/// How rows of a matrix are shared out: a work group for some rows, whose sums are put together in shared
/// memory, so that neighbouring invocations read neighbouring numbers (graphics cards); or rows for each
/// invocation, without shared memory and barriers, or for eight, one vector of the processor, which read
/// texels (drivers that compute on the CPU).
enum class RowStrategy { group, invocation };

/// A context with what all operators on it share: compiled shaders, the buffers that fields pass through,
/// texture units, palettes of textures, a timer. Everything but open() is called with the context current.
class GlDevice {
 public:
  static std::shared_ptr<GlDevice> open(const GlContextOptions& options = {});

  const std::shared_ptr<const GlContext>& context() const { return context_; }
  FieldBuffers& fields() { return fields_; }
  GlTimer& timer() { return timer_; }
  TexelUnits& texels() { return texels_; }
  TexturePalettes& palettes() { return palettes_; }
  /// Compiled when it is asked for first.
  const GlProgram& program(const ShaderVariant& variant);
  /// Has it begin with what was asked of it, while the CPU goes on.
  void flush() const;
  /// What suits the renderer.
  RowStrategy preferred_strategy() const {
    return context_->software() ? RowStrategy::invocation : RowStrategy::group;
  }

 private:
  explicit GlDevice(const std::shared_ptr<const GlContext>& context)
      : context_(context), fields_(context), timer_(context), texels_(context), palettes_(context) {}

  std::shared_ptr<const GlContext> context_;
  FieldBuffers fields_;
  GlTimer timer_;
  TexelUnits texels_;
  TexturePalettes palettes_;
  std::vector<std::pair<ShaderVariant, std::unique_ptr<GlProgram>>> programs_;
};

/// "Mesa llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile) Mesa 22.3.6 (a software renderer: ...)",
/// for a terminal.
std::string renderer_text(const GlContext& context);

}  // namespace radiosity

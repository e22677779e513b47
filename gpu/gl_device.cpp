#include "gpu/gl_device.hpp"

#include <fmt/format.h>

#include <epoxy/gl.h>

namespace radiosity {

std::shared_ptr<GlDevice> GlDevice::open(const GlContextOptions& options) {
  const std::shared_ptr<const GlContext> context = GlContext::open(options);
  const CurrentContext current(*context);
  return std::shared_ptr<GlDevice>(new GlDevice(context));
}

const GlProgram& GlDevice::program(const ShaderVariant& variant) {
  for (const auto& [known, program] : programs_)
    if (known == variant) return *program;
  programs_.emplace_back(variant, std::make_unique<GlProgram>(context_, variant));
  return *programs_.back().second;
}

void GlDevice::flush() const {
  glFlush();
}

std::string renderer_text(const GlContext& context) {
  return fmt::format("{}, OpenGL {}{}", context.renderer(), context.version(),
                     context.software() ? " (a software renderer: it computes on the CPU)" : "");
}

}  // namespace radiosity

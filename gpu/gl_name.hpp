#pragma once

#include "gpu/gl_context.hpp"

#include <memory>
#include <utility>

namespace radiosity {

/// The name of an OpenGL object that is deleted with this. The context is current when it is made.
class GlName {
 public:
  using Generate = void (*)(int count, unsigned* names);
  using Delete = void (*)(int count, const unsigned* names);

  /// As in GlName(context, glGenTextures, glDeleteTextures).
  GlName(std::shared_ptr<const GlContext> context, Generate generate, Delete release)
      : context_(std::move(context)), release_(release) {
    generate(1, &name_);
  }
  ~GlName() {
    context_->when_current([this] { release_(1, &name_); });
  }
  GlName(const GlName&) = delete;
  GlName& operator=(const GlName&) = delete;

  unsigned get() const { return name_; }

 private:
  std::shared_ptr<const GlContext> context_;
  Delete release_;
  unsigned name_ = 0;
};

}  // namespace radiosity

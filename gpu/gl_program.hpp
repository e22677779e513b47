#pragma once

#include "gpu/gl_context.hpp"
#include "gpu/shader_sources.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace radiosity {

/// A compute shader, compiled, or the stages of a drawing. The context is current in every call but the
/// destructor's.
class GlProgram {
 public:
  /// Throws Error with the driver's log where the text does not compile.
  GlProgram(std::shared_ptr<const GlContext> context, const ShaderVariant& variant);
  /// Of .vert, .geom and .frag files.
  GlProgram(std::shared_ptr<const GlContext> context, const std::vector<ShaderVariant>& stages);
  GlProgram(std::shared_ptr<const GlContext> context, const std::string& name, const std::string& text);
  ~GlProgram();
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;

  /// What set() and dispatch() mean until another program is used.
  void use() const;
  /// Sets a uniform of type uint. Throws UsageError where the shader declares none of that name.
  void set(const char* uniform, std::int64_t value) const;
  /// At least `groups` work groups, numbered by group_index() of groups.glsl; groups > 0.
  void dispatch(std::int64_t groups) const;

 private:
  /// The text of one stage; `file` says in its ending which.
  struct Stage {
    std::string file;
    std::string text;
  };
  void link(const std::vector<Stage>& stages);

  std::shared_ptr<const GlContext> context_;
  std::string file_;  ///< of the last stage
  unsigned name_ = 0;
  std::vector<std::pair<std::string, int>> uniforms_;
};

}  // namespace radiosity

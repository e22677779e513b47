#include "gpu/gl_program.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <array>
#include <epoxy/gl.h>

namespace radiosity {
namespace {

/// A shader that is deleted when it has been linked.
struct Shader {
  GLuint name = glCreateShader(GL_COMPUTE_SHADER);
  Shader() = default;
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  ~Shader() { glDeleteShader(name); }
};

std::string log_of(GLuint object, decltype(glGetShaderiv) get, decltype(glGetShaderInfoLog) get_log) {
  GLint length = 0;
  get(object, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  GLsizei written = 0;
  get_log(object, length, &written, log.data());
  log.resize(static_cast<std::size_t>(written));
  return log;
}

void compile(GLuint shader, const std::string& file, const std::string& text) {
  const char* begin = text.c_str();
  glShaderSource(shader, 1, &begin, nullptr);
  glCompileShader(shader);
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_FALSE)
    fail("the shader {} does not compile: {}", file, log_of(shader, glGetShaderiv, glGetShaderInfoLog));
}

std::vector<std::pair<std::string, int>> uniforms_of(GLuint program) {
  GLint count = 0;
  glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
  std::vector<std::pair<std::string, int>> uniforms;
  for (GLint i = 0; i < count; ++i) {
    std::array<char, 64> name{};
    GLint size = 0;
    GLenum type = 0;
    glGetActiveUniform(program, static_cast<GLuint>(i), static_cast<GLsizei>(name.size()), nullptr, &size,
                       &type, name.data());
    uniforms.emplace_back(name.data(), glGetUniformLocation(program, name.data()));
  }
  return uniforms;
}

}  // namespace

GlProgram::GlProgram(std::shared_ptr<const GlContext> context, const ShaderVariant& variant)
    : GlProgram(std::move(context), variant.file, shader_text(variant)) {}

GlProgram::GlProgram(std::shared_ptr<const GlContext> context, const std::string& name,
                     const std::string& text)
    : context_(std::move(context)), file_(name) {
  const Shader shader;
  compile(shader.name, file_, text);
  name_ = glCreateProgram();
  glAttachShader(name_, shader.name);
  glLinkProgram(name_);
  glDetachShader(name_, shader.name);
  GLint linked = GL_FALSE;
  glGetProgramiv(name_, GL_LINK_STATUS, &linked);
  if (linked == GL_FALSE) {
    const std::string log = log_of(name_, glGetProgramiv, glGetProgramInfoLog);
    glDeleteProgram(name_);
    fail("the shader {} does not link: {}", file_, log);
  }
  uniforms_ = uniforms_of(name_);
}

GlProgram::~GlProgram() {
  const CurrentContext current(*context_);
  glDeleteProgram(name_);
}

void GlProgram::use() const {
  glUseProgram(name_);
}

void GlProgram::set(const char* uniform, std::int64_t value) const {
  const auto found = std::find_if(uniforms_.begin(), uniforms_.end(),
                                  [&](const auto& candidate) { return candidate.first == uniform; });
  if (found == uniforms_.end()) fail<UsageError>("the shader {} has no uniform '{}'", file_, uniform);
  glUniform1ui(found->second, static_cast<GLuint>(value));
}

void GlProgram::dispatch(std::int64_t groups) const {
  const std::int64_t most = context_->limits().group_count[0];
  const std::int64_t across = std::min(groups, most);
  glDispatchCompute(static_cast<GLuint>(across), static_cast<GLuint>((groups + across - 1) / across), 1);
}

}  // namespace radiosity

#include "gpu/gl_program.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <epoxy/gl.h>
#include <string_view>

namespace radiosity {
namespace {

/// A shader that is deleted when it has been linked.
struct Shader {
  GLuint name;
  explicit Shader(GLenum kind) : name(glCreateShader(kind)) {}
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  ~Shader() { glDeleteShader(name); }
};

GLenum kind_of(const std::string& file) {
  if (file.ends_with(".vert")) return GL_VERTEX_SHADER;
  if (file.ends_with(".geom")) return GL_GEOMETRY_SHADER;
  if (file.ends_with(".frag")) return GL_FRAGMENT_SHADER;
  return GL_COMPUTE_SHADER;
}

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

/// The uniforms that the text declares with their places: -1, which OpenGL ignores, where the variant does
/// not read them.
std::vector<std::pair<std::string, int>> uniforms_of(GLuint program, std::string_view text) {
  constexpr std::string_view declaration = "uniform uint ";
  std::vector<std::pair<std::string, int>> uniforms;
  for (auto at = text.find(declaration); at != std::string_view::npos; at = text.find(declaration)) {
    text.remove_prefix(at + declaration.size());
    const std::string name(text.substr(0, text.find(';')));
    uniforms.emplace_back(name, glGetUniformLocation(program, name.c_str()));
  }
  return uniforms;
}

}  // namespace

GlProgram::GlProgram(std::shared_ptr<const GlContext> context, const ShaderVariant& variant)
    : GlProgram(std::move(context), variant.file, shader_text(variant)) {}

GlProgram::GlProgram(std::shared_ptr<const GlContext> context, const std::string& name,
                     const std::string& text)
    : context_(std::move(context)) {
  link({{name, text}});
}

GlProgram::GlProgram(std::shared_ptr<const GlContext> context, const std::vector<ShaderVariant>& stages)
    : context_(std::move(context)) {
  std::vector<Stage> texts;
  texts.reserve(stages.size());
  for (const ShaderVariant& stage : stages) texts.push_back({stage.file, shader_text(stage)});
  link(texts);
}

void GlProgram::link(const std::vector<Stage>& stages) {
  file_ = stages.back().file;
  name_ = glCreateProgram();
  try {
    for (const Stage& stage : stages) {
      const Shader shader(kind_of(stage.file));
      compile(shader.name, stage.file, stage.text);
      glAttachShader(name_, shader.name);  // which keeps it until the program is deleted
    }
    glLinkProgram(name_);
    GLint linked = GL_FALSE;
    glGetProgramiv(name_, GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE)
      fail("the shader {} does not link: {}", file_, log_of(name_, glGetProgramiv, glGetProgramInfoLog));
  } catch (...) {
    glDeleteProgram(name_);
    throw;
  }
  for (const Stage& stage : stages)
    for (const auto& uniform : uniforms_of(name_, stage.text)) uniforms_.push_back(uniform);
}

GlProgram::~GlProgram() {
  context_->when_current([this] { glDeleteProgram(name_); });
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

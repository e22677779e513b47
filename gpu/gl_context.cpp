#include "gpu/gl_context.hpp"

#include "foundation/error.hpp"
#include "gpu/egl_display.hpp"

#define EGL_NO_X11
#include <algorithm>
#include <cctype>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <utility>

namespace radiosity {

/// What the driver's debug output calls.
struct DebugMessages {
  static void APIENTRY receive(GLenum, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* message,
                               const void* user) {
    const bool wrong = type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR ||
                       severity == GL_DEBUG_SEVERITY_HIGH;
    const auto* context = static_cast<const GlContext*>(user);
    if (wrong && context->complaint_.empty()) context->complaint_ = message;
  }
};

namespace {

constexpr std::array<std::pair<int, int>, 3> versions = {{{4, 6}, {4, 5}, {4, 3}}};

EGLContext create_context(EGLDisplay display, EGLConfig config, bool debug) {
  for (const auto& [major, minor] : versions) {
    const std::array<EGLint, 9> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                              major,
                                              EGL_CONTEXT_MINOR_VERSION,
                                              minor,
                                              EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                              EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                              EGL_CONTEXT_OPENGL_DEBUG,
                                              debug ? EGL_TRUE : EGL_FALSE,
                                              EGL_NONE};
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
    if (context != EGL_NO_CONTEXT) return context;
  }
  return EGL_NO_CONTEXT;
}

/// Any configuration for OpenGL: nothing is ever drawn.
EGLConfig any_config(EGLDisplay display) {
  if (epoxy_has_egl_extension(display, "EGL_KHR_no_config_context")) return EGL_NO_CONFIG_KHR;
  const std::array<EGLint, 3> attributes = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  eglChooseConfig(display, attributes.data(), &config, 1, &count);
  return config;
}

/// EGL_NO_CONTEXT if the display has none without a surface. The display stays initialized: others of this
/// process may have got the same one, and EGL does not count.
EGLContext open_on(const EglDisplay& display, bool debug) {
  if (!eglInitialize(display.handle, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API)) return EGL_NO_CONTEXT;
  if (!epoxy_has_egl_extension(display.handle, "EGL_KHR_surfaceless_context")) return EGL_NO_CONTEXT;
  return create_context(display.handle, any_config(display.handle), debug);
}

std::string gl_text(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(text));
}

/// For drivers in software that do not say so.
bool names_software(std::string renderer) {
  std::transform(renderer.begin(), renderer.end(), renderer.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array<const char*, 4> names = {"llvmpipe", "softpipe", "swrast", "swiftshader"};
  return std::any_of(names.begin(), names.end(),
                     [&](const char* name) { return renderer.find(name) != std::string::npos; });
}

const char* error_name(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "invalid enumeration";
    case GL_INVALID_VALUE:
      return "invalid value";
    case GL_INVALID_OPERATION:
      return "invalid operation";
    case GL_OUT_OF_MEMORY:
      return "out of memory";
    default:
      return "error";
  }
}

}  // namespace

std::shared_ptr<GlContext> GlContext::open(const GlContextOptions& options) {
  if (const std::string missing = missing_gl_library(options.libraries); !missing.empty())
    throw Error(missing + options.otherwise);
  std::shared_ptr<GlContext> result(new GlContext);
  for (const EglDisplay& display : egl_displays()) {
    result->context_ = open_on(display, options.debug);
    if (result->context_ == EGL_NO_CONTEXT) continue;
    result->display_ = display.handle;
    result->platform_ = display.platform;
    result->software_ = display.software;
    break;
  }
  if (result->context_ == EGL_NO_CONTEXT)
    fail(
        "there is no OpenGL 4.3 or later here: install its driver (Debian package libgl1-mesa-dri computes "
        "on the CPU where there is no graphics card){}",
        options.otherwise);
  result->debug_ = options.debug;
  const CurrentContext current(*result);
  result->read_strings_and_limits();
  if (options.storage_block_bytes)
    result->limits_.storage_block_bytes =
        std::min(result->limits_.storage_block_bytes, *options.storage_block_bytes);
  if (options.texture_side)
    result->limits_.texture_side = std::min(result->limits_.texture_side, *options.texture_side);
  return result;
}

void GlContext::read_strings_and_limits() {
  renderer_ = gl_text(GL_RENDERER);
  vendor_ = gl_text(GL_VENDOR);
  version_ = gl_text(GL_VERSION);
  software_ = software_ || names_software(renderer_);
  GLint64 bytes = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
  limits_.storage_block_bytes = bytes;
  for (GLuint way = 0; way < 3; ++way) {
    glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, way, &limits_.group_count[way]);
    glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_SIZE, way, &limits_.group_size[way]);
  }
  glGetIntegerv(GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS, &limits_.group_invocations);
  glGetIntegerv(GL_MAX_COMPUTE_SHARED_MEMORY_SIZE, &limits_.shared_bytes);
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limits_.texture_side);
  if (debug_) {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);  // on this thread, before the call that is wrong returns
    glDebugMessageCallback(&DebugMessages::receive, this);
  }
  check("opening a context");
}

GlContext::~GlContext() {
  if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
}

void GlContext::count_sent(std::size_t bytes) const {
  ++traffic_.sendings;
  traffic_.sent_bytes += bytes;
}

void GlContext::count_received(std::size_t bytes) const {
  ++traffic_.receipts;
  traffic_.received_bytes += bytes;
}

void GlContext::check(const std::string& work) const {
  const GLenum error = glGetError();
  const std::string complaint = std::exchange(complaint_, {});
  if (error == GL_OUT_OF_MEMORY)
    fail("{}: the device '{}' is out of memory; use fewer patches or --device cpu", work, renderer_);
  if (!complaint.empty()) fail("{}: OpenGL ('{}') says: {}", work, renderer_, complaint);
  if (error != GL_NO_ERROR) fail("{}: OpenGL ('{}') reports: {}", work, renderer_, error_name(error));
}

bool GlContext::try_acquire() const noexcept {
  mutex_.lock();
  if (depth_ == 0) {
    eglBindAPI(EGL_OPENGL_API);  // of this thread: without it the context could not be released
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
      mutex_.unlock();
      return false;
    }
  }
  ++depth_;
  return true;
}

void GlContext::leave() const noexcept {
  --depth_;
  if (depth_ == 0) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  mutex_.unlock();
}

CurrentContext::CurrentContext(const GlContext& context) : context_(context) {
  if (!context_.try_acquire())
    fail("the OpenGL context of '{}' cannot be used on this thread (EGL error {:#x})", context_.renderer(),
         static_cast<unsigned>(eglGetError()));
}

CurrentContext::~CurrentContext() {
  context_.leave();
}

}  // namespace radiosity

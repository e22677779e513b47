#pragma once

#include <epoxy/gl.h>
#include <map>
#include <string>
#include <vector>

namespace radiosity {

// Every OpenGL function that gpu/ and frame/ call (a test compares).
// clang-format off
#define RADIOSITY_GL_FUNCTIONS(X) \
  X(glActiveTexture) X(glAttachShader) X(glBeginQuery) X(glBindBuffer) X(glBindBufferBase) \
  X(glBindBufferRange) X(glBindFramebuffer) X(glBindRenderbuffer) X(glBindTexture) X(glBindVertexArray) \
  X(glBufferData) X(glBufferSubData) X(glClear) X(glClearBufferData) X(glClearBufferuiv) X(glClearColor) X(glClientWaitSync) X(glCompileShader) \
  X(glCompressedTexSubImage2D) X(glCreateProgram) X(glCreateShader) X(glDebugMessageCallback) X(glDeleteBuffers) \
  X(glDeleteFramebuffers) X(glDeleteProgram) X(glDeleteQueries) X(glDeleteRenderbuffers) \
  X(glDeleteShader) X(glDeleteSync) X(glDeleteTextures) X(glDeleteVertexArrays) X(glDisable) \
  X(glDispatchCompute) X(glDrawArrays) X(glDrawBuffer) X(glDrawElements) X(glEnable) \
  X(glEnableVertexAttribArray) X(glEndQuery) X(glFenceSync) X(glFinish) X(glFlush) \
  X(glFramebufferRenderbuffer) X(glFramebufferTexture) X(glGenBuffers) X(glGenFramebuffers) \
  X(glGenQueries) X(glGenRenderbuffers) X(glGenTextures) X(glGenVertexArrays) X(glGetBufferParameteri64v) X(glGetBufferSubData) \
  X(glGetError) X(glGetInteger64i_v) X(glGetInteger64v) X(glGetIntegeri_v) X(glGetIntegerv) X(glGetProgramInfoLog) \
  X(glGetProgramiv) X(glGetQueryObjectui64v) X(glGetShaderInfoLog) X(glGetShaderiv) X(glGetString) \
  X(glGetUniformLocation) X(glLinkProgram) X(glMapBufferRange) X(glMemoryBarrier) X(glPixelStorei) \
  X(glQueryCounter) X(glReadPixels) X(glRenderbufferStorage) X(glShaderSource) X(glTexBufferRange) X(glTexParameteri) \
  X(glTexStorage2D) X(glTexStorage3D) X(glUniform1ui) X(glUnmapBuffer) X(glUseProgram) X(glVertexAttribPointer) \
  X(glViewport)
// clang-format on

/// What stands in the place of an OpenGL function while it is counted.
template <auto Function>
struct CountedFunction;

template <typename Result, typename... Arguments, Result (**Function)(Arguments...)>
struct CountedFunction<Function> {
  static inline Result (*original)(Arguments...) = nullptr;
  static inline int calls = 0;

  static Result call(Arguments... arguments) {
    ++calls;
    return original(arguments...);
  }
  static void begin() {
    original = *Function;
    *Function = &call;
    calls = 0;
  }
  static void end() { *Function = original; }
};

/// Counts the OpenGL calls of this process while it lives, one at a time. Each function was called before:
/// libepoxy puts itself in its place until then.
class GlCallCounter {
 public:
  GlCallCounter() {
#define RADIOSITY_BEGIN(function) CountedFunction<&(function)>::begin();
    RADIOSITY_GL_FUNCTIONS(RADIOSITY_BEGIN)
#undef RADIOSITY_BEGIN
  }
  ~GlCallCounter() {
#define RADIOSITY_END(function) CountedFunction<&(function)>::end();
    RADIOSITY_GL_FUNCTIONS(RADIOSITY_END)
#undef RADIOSITY_END
  }
  GlCallCounter(const GlCallCounter&) = delete;
  GlCallCounter& operator=(const GlCallCounter&) = delete;

  /// Of each function that was called, since the last time.
  static std::map<std::string, int> take() {
    std::map<std::string, int> calls;
#define RADIOSITY_TAKE(function)                                                                       \
  if (CountedFunction<&(function)>::calls > 0) calls[#function] = CountedFunction<&(function)>::calls; \
  CountedFunction<&(function)>::calls = 0;
    RADIOSITY_GL_FUNCTIONS(RADIOSITY_TAKE)
#undef RADIOSITY_TAKE
    return calls;
  }

  static std::vector<std::string> functions() {
    std::vector<std::string> names;
#define RADIOSITY_NAME(function) names.emplace_back(#function);
    RADIOSITY_GL_FUNCTIONS(RADIOSITY_NAME)
#undef RADIOSITY_NAME
    return names;
  }
};

}  // namespace radiosity

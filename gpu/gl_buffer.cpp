#include "gpu/gl_buffer.hpp"

#include <fmt/format.h>

#include <epoxy/gl.h>
#include <utility>

namespace radiosity {

GlBuffer::GlBuffer(std::shared_ptr<const GlContext> context, std::size_t bytes)
    : context_(std::move(context)), bytes_(bytes) {
  glGenBuffers(1, &name_);
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, name_);
  glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_STATIC_DRAW);
  try {
    context_->check(fmt::format("a buffer of {} bytes", bytes));
  } catch (...) {
    glDeleteBuffers(1, &name_);
    throw;
  }
}

GlBuffer::GlBuffer(GlBuffer&& other) noexcept
    : context_(std::move(other.context_)), name_(std::exchange(other.name_, 0)), bytes_(other.bytes_) {}

GlBuffer::~GlBuffer() {
  if (name_ != 0) context_->when_current([this] { glDeleteBuffers(1, &name_); });
}

void GlBuffer::write(std::size_t offset, std::size_t bytes, const void* data) {
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, name_);
  glBufferSubData(GL_SHADER_STORAGE_BUFFER, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes),
                  data);
  context_->count_sent(bytes);
}

void GlBuffer::read(std::size_t bytes, void* data) const {
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, name_);
  glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(bytes), data);
  context_->count_received(bytes);
}

void GlBuffer::clear() {
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, name_);
  glClearBufferData(GL_SHADER_STORAGE_BUFFER, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
}

void GlBuffer::bind(unsigned binding) const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name_);
}

void GlBuffer::bind_range(unsigned binding, std::size_t offset, std::size_t bytes) const {
  glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, name_, static_cast<GLintptr>(offset),
                    static_cast<GLsizeiptr>(bytes));
}

void GlBuffer::bind_uniform(unsigned binding) const {
  glBindBufferBase(GL_UNIFORM_BUFFER, binding, name_);
}

GlBuffer& GrowingBuffer::reserve(const std::shared_ptr<const GlContext>& context, std::size_t bytes) {
  if (!buffer_ || buffer_->bytes() < bytes) {
    buffer_.reset();
    buffer_ = std::make_unique<GlBuffer>(context, bytes);
  }
  return *buffer_;
}

}  // namespace radiosity

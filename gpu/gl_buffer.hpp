#pragma once

#include "gpu/gl_context.hpp"

#include <cstddef>
#include <memory>

namespace radiosity {

/// Memory of the device, for shaders to read and write. The context is current in every call but the
/// destructor's.
class GlBuffer {
 public:
  /// Of `bytes` > 0, not set. Throws Error where the device has no room for it.
  GlBuffer(std::shared_ptr<const GlContext> context, std::size_t bytes);
  ~GlBuffer();
  GlBuffer(GlBuffer&& other) noexcept;
  GlBuffer& operator=(GlBuffer&&) = delete;
  GlBuffer(const GlBuffer&) = delete;
  GlBuffer& operator=(const GlBuffer&) = delete;

  std::size_t bytes() const { return bytes_; }

  /// Copies `bytes` bytes to those of the buffer from `offset` on.
  void write(std::size_t offset, std::size_t bytes, const void* data);
  /// Copies its first bytes back: waits until what wrote them is done. A memory barrier comes before it.
  void read(std::size_t bytes, void* data) const;
  /// Sets all of it to zero bits.
  void clear();
  /// As storage block `binding` of the shaders.
  void bind(unsigned binding) const;
  /// The same for `bytes` of it from `offset` on, a multiple of 256.
  void bind_range(unsigned binding, std::size_t offset, std::size_t bytes) const;
  /// As uniform block `binding`.
  void bind_uniform(unsigned binding) const;
  /// OpenGL's, for what else a buffer can be: vertices, pixels.
  unsigned name() const { return name_; }

 private:
  std::shared_ptr<const GlContext> context_;
  unsigned name_ = 0;
  std::size_t bytes_ = 0;
};

/// A buffer that is made when it is needed and again, larger, when it is too small.
class GrowingBuffer {
 public:
  /// At least `bytes` of it; what was in it is lost where it has to grow.
  GlBuffer& reserve(const std::shared_ptr<const GlContext>& context, std::size_t bytes);

 private:
  std::unique_ptr<GlBuffer> buffer_;
};

}  // namespace radiosity

#pragma once

#include "gpu/gl_library.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// What a driver states of itself.
struct GlLimits {
  std::int64_t storage_block_bytes = 0;  ///< of one buffer that a shader reads: larger matrices are split
  std::array<int, 3> group_count{};      ///< work groups of a dispatch, each way
  std::array<int, 3> group_size{};       ///< invocations of a work group, each way
  int group_invocations = 0;             ///< and in all
  int shared_bytes = 0;                  ///< of a work group
  int texture_side = 0;                  ///< texels, of a texture each way
};

/// What has gone between the processor's memory and the device's so far.
struct GlTraffic {
  std::uint64_t sendings = 0;
  std::uint64_t sent_bytes = 0;
  std::uint64_t receipts = 0;  ///< each waits for the device
  std::uint64_t received_bytes = 0;
};

#ifdef NDEBUG
constexpr bool gl_debug_by_default = false;
#else
constexpr bool gl_debug_by_default = true;
#endif

struct GlContextOptions {
  /// A context that reports what is wrong or undefined, which check() throws; slower.
  bool debug = gl_debug_by_default;
  /// Below what the driver states: for tests.
  std::optional<std::int64_t> storage_block_bytes = {};
  std::optional<int> texture_side = {};
  std::vector<GlLibrary> libraries = required_gl_libraries();
  /// What can be done without OpenGL, at the end of the sentence that says that there is none.
  std::string otherwise = ", or use --device cpu";
};

/// An OpenGL context without a window: core profile 4.6, else 4.5, else 4.3, which has all that is needed
/// (compute shaders, storage buffers, debug output). It belongs to no thread: whoever calls OpenGL holds a
/// CurrentContext meanwhile.
class GlContext {
 public:
  /// On the first of egl_displays() that has one. Throws Error in one sentence with what to install where
  /// there is no OpenGL, or none of 4.3.
  static std::shared_ptr<GlContext> open(const GlContextOptions& options = {});

  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  const std::string& renderer() const { return renderer_; }  ///< "llvmpipe (LLVM 15.0.6, 256 bits)"
  const std::string& vendor() const { return vendor_; }
  const std::string& version() const { return version_; }    ///< "4.5 (Core Profile) Mesa 22.3.6"
  const std::string& platform() const { return platform_; }  ///< as in EglDisplay
  bool software() const { return software_; }                ///< computes on the CPU: right results, no speed
  bool debug() const { return debug_; }
  const GlLimits& limits() const { return limits_; }

  /// The context is current in these three.
  const GlTraffic& traffic() const { return traffic_; }
  void count_sent(std::size_t bytes) const;
  void count_received(std::size_t bytes) const;

  /// Throws Error if OpenGL reported an error since the last call: of any kind in a debug context, else what
  /// glGetError says. `work` names what was done ("a buffer of 12 bytes"). The context is current.
  void check(const std::string& work) const;

  /// Calls `release` with the context current, for destructors of what lives in it. Where it cannot be made
  /// current, that ends with the context.
  template <typename Release>
  void when_current(const Release& release) const noexcept {
    if (!try_acquire()) return;
    release();
    leave();
  }

 private:
  friend class CurrentContext;
  friend struct DebugMessages;
  GlContext() = default;

  bool try_acquire() const noexcept;
  void leave() const noexcept;
  void read_strings_and_limits();

  void* display_ = nullptr;
  void* context_ = nullptr;
  std::string renderer_, vendor_, version_, platform_;
  bool software_ = false;
  bool debug_ = false;
  GlLimits limits_;
  mutable std::recursive_mutex mutex_;
  mutable int depth_ = 0;  ///< of CurrentContexts that the thread which has the mutex holds
  mutable GlTraffic traffic_;
  mutable std::string complaint_;  ///< the first message of the debug output that is an error
};

/// The context is current on this thread, and on no other, while this lives. May be nested.
class CurrentContext {
 public:
  explicit CurrentContext(const GlContext& context);
  ~CurrentContext();
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;

 private:
  const GlContext& context_;
};

}  // namespace radiosity

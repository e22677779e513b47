#pragma once

#include "foundation/error.hpp"
#include "gpu/gl_device.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <optional>

namespace radiosity {

/// Tests that need OpenGL, in a context that reports everything that is wrong. They are skipped where there
/// is none, which ./check counts as a failure with CI=true.
class DeviceTest : public ::testing::Test {
 protected:
  void SetUp() override {
    try {
      device();
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }

  /// One for all tests of a process.
  static const std::shared_ptr<GlDevice>& device() {
    static const std::shared_ptr<GlDevice> shared = GlDevice::open({.debug = true});
    return shared;
  }

  /// One that says that it has smaller storage blocks than it has.
  static std::shared_ptr<GlDevice> device_with_blocks_of(std::int64_t bytes) {
    return GlDevice::open({.debug = true, .storage_block_bytes = bytes});
  }
};

}  // namespace radiosity

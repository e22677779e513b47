#pragma once

#include "apps/program.hpp"
#include "apps/run_options.hpp"
#include "gpu/gl_device.hpp"
#include "operators/linear_operator.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// The device that --device names; null for cpu. Throws UsageError for one that does not exist and Error
/// where there is no OpenGL.
std::shared_ptr<GlDevice> open_device(const RunOptions& options, const GlContextOptions& context = {});

/// The program with its operators on that device. Throws as open_device() does, and UsageError where one of
/// `specs` cannot run there or, on the CPU, has a key for devices alone, before anything is computed.
Program on_device(const Program& program, const RunOptions& options, const std::vector<std::string>& specs);

/// For commands that multiply with no operator: throws UsageError for every device but cpu.
void require_cpu(const RunOptions& options, const std::string& command);

/// "device     gl: llvmpipe (...), a software renderer ...", for a terminal; empty for the CPU.
std::string device_line(const std::optional<DeviceUse>& use);

}  // namespace radiosity

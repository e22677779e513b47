#include "apps/device_choice.hpp"

#include "foundation/error.hpp"
#include "gpu/gl_operators.hpp"
#include "gpu/gl_solvers.hpp"
#include "gpu/upload.hpp"

#include <fmt/format.h>

#include <cstdlib>

namespace radiosity {
namespace {

void require_known_device(const RunOptions& options) {
  if (options.device != "cpu" && options.device != "gl")
    fail<UsageError>("--device {}: there is no such device; the known ones are cpu and gl", options.device);
}

}  // namespace

std::shared_ptr<GlDevice> open_device(const RunOptions& options, const GlContextOptions& context) {
  require_known_device(options);
  if (options.device != "gl") return nullptr;
  // A driver that is not there would be reported in Mesa's words as well; who wants them sets the variable.
  constexpr int keep = 0;
  ::setenv("EGL_LOG_LEVEL", "fatal", keep);
  if (options.threads > 0)
    ::setenv("LP_NUM_THREADS", std::to_string(options.threads).c_str(), keep);  // llvmpipe
  return GlDevice::open(context);
}

Program on_device(const Program& program, const RunOptions& options, const std::vector<std::string>& specs) {
  require_known_device(options);
  if (options.device == "cpu") {
    for (const std::string& spec : specs) require_no_device_keys(spec);
    return program;
  }
  for (const std::string& spec : specs) require_uploadable(spec);
  return {gl_operators(open_device(options), program.operators), gl_solvers(program.solvers)};
}

void require_cpu(const RunOptions& options, const std::string& command) {
  require_known_device(options);
  if (options.device != "cpu")
    fail<UsageError>("--device {}: {} multiplies with no operator that could run there; use --device cpu",
                     options.device, command);
}

std::string device_line(const std::optional<DeviceUse>& use) {
  if (!use) return {};
  return fmt::format("device     {}: {}{}; largest difference from the CPU {:.1e}\n", use->name,
                     use->renderer, use->software ? ", a software renderer: it computes on the CPU" : "",
                     use->difference_max);
}

}  // namespace radiosity

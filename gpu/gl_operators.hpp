#pragma once

#include "gpu/gl_device.hpp"
#include "operators/operator_registry.hpp"

#include <memory>

namespace radiosity {

/// The operators of `cpu` on a device: each, or its global operator, is built on the CPU and copied
/// (gpu/upload.hpp). Each has a further key, `strategy=auto|group|invocation` (RowStrategy; auto: the
/// device's own), those of low rank also `placement=device|hybrid` (Placement), `dxt` with BC1 blocks also
/// `blocks=buffer|texture` (BlockPlacement). Those that have no form for the device stay in the list and are
/// refused when they are made; closures act on what is on the device.
OperatorRegistry gl_operators(const std::shared_ptr<GlDevice>& device, const OperatorRegistry& cpu);

/// For operators that stay on the CPU: throws UsageError, which says so, where `spec` asks for what only
/// devices do: `strategy=...`, `placement=...`, `blocks=buffer` or `blocks=texture`.
void require_no_device_keys(const std::string& spec);

}  // namespace radiosity

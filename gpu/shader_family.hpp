#pragma once

#include "gpu/gl_device.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace radiosity {

/// Columns that a shader multiplies with each number that it reads; more take further dispatches.
constexpr Index device_columns_at_once = 4;

/// A shader for 1 to 4 columns (its constant COLUMNS), each compiled when it is first used and found without
/// a search after that.
class ShaderFamily {
 public:
  ShaderFamily(std::string file, std::vector<std::pair<std::string, int>> defines)
      : variant_{std::move(file), std::move(defines)} {}

  /// Calls dispatch(program, first column) for groups of the columns, with their program in use. The
  /// context of the device is current.
  template <typename Dispatch>
  void for_columns(GlDevice& device, Index columns, const Dispatch& dispatch) const {
    for (Index first = 0; first < columns; first += device_columns_at_once) {
      const Index together = std::min(device_columns_at_once, columns - first);
      const GlProgram& program = with_columns(device, together);
      program.use();
      dispatch(program, first);
    }
  }

 private:
  const GlProgram& with_columns(GlDevice& device, Index columns) const {
    const GlProgram*& program = compiled_[static_cast<std::size_t>(columns - 1)];
    if (program == nullptr) {
      ShaderVariant variant = variant_;
      variant.defines.emplace_back("COLUMNS", static_cast<int>(columns));
      program = &device.program(variant);
    }
    return *program;
  }

  ShaderVariant variant_;
  mutable std::array<const GlProgram*, device_columns_at_once> compiled_{};  ///< the device's
};

}  // namespace radiosity

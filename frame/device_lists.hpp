#pragma once

#include "frame/emission_points.hpp"
#include "gpu/gl_buffer.hpp"
#include "gpu/gl_device.hpp"

#include <memory>
#include <vector>

namespace radiosity {

/// Copies of lists for shaders; at least one number each. They throw Error where a list takes more than a
/// storage block. The context is current.
GlBuffer device_list(const std::shared_ptr<const GlContext>& context, const std::vector<float>& numbers);
GlBuffer device_list(const std::shared_ptr<const GlContext>& context,
                     const std::vector<std::uint32_t>& numbers);

/// n x 3 by columns, padded as FieldBuffers has them.
GlBuffer device_columns(const std::shared_ptr<const GlContext>& context, const Eigen::MatrixXd& field);

}  // namespace radiosity

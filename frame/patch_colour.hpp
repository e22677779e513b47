#pragma once

#include "scene/patch_mesh.hpp"

namespace radiosity {

/// Of a field of one column or three.
inline Color colour_of(const Eigen::MatrixXd& field, Index patch) {
  return field.cols() == 3 ? Color(field.row(patch).transpose().array()) : Color::Constant(field(patch, 0));
}

}  // namespace radiosity

#pragma once

#include "scene/scene.hpp"

namespace radiosity {

/// The makers behind built_in_scenes(), one source file each.
Scene make_cube();
Scene make_cornell_box();
Scene make_closed_cornell_box();
Scene make_course_box();

}  // namespace radiosity

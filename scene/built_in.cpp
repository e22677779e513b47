#include "scene/built_in.hpp"

#include "foundation/error.hpp"
#include "scene/built_in_geometry.hpp"

namespace radiosity {

const std::vector<BuiltInScene>& built_in_scenes() {
  static const std::vector<BuiltInScene> scenes = {
      {"cube", "unit cube seen from inside, grey 0.5, the ceiling emits 1 W/m^2", make_cube},
      {"cornell-box", "Cornell's measured box and spectra, front open, metres", make_cornell_box},
      {"cornell-box-closed", "the measured box with plane walls and a white front wall: watertight",
       make_closed_cornell_box},
      {"course-box", "the 30 triangles of a course's Cornell box, side 555, front open", make_course_box},
  };
  return scenes;
}

Scene built_in_scene(const std::string& name) {
  std::string known;
  for (const BuiltInScene& scene : built_in_scenes()) {
    if (scene.name == name) return scene.make();
    known += (known.empty() ? "" : ", ") + scene.name;
  }
  fail<UsageError>("there is no built-in scene '{}'; the known ones are {}", name, known);
}

}  // namespace radiosity

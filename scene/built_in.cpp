#include "scene/built_in.hpp"

#include "foundation/error.hpp"
#include "scene/built_in_geometry.hpp"

#include <algorithm>

namespace radiosity {

const std::vector<BuiltInScene>& built_in_scenes() {
  static const std::vector<BuiltInScene> scenes = {
      {"cube", "cube", "unit cube seen from inside, grey 0.5, the ceiling emits 1 W/m^2", make_cube},
      {"cornell-box", "cornell-box", "Cornell's measured box and spectra, front open, metres",
       make_cornell_box},
      {"cornell-box-closed", "cornell-box-closed",
       "the measured box with plane walls and a white front wall: watertight", make_closed_cornell_box},
      {"course-box", "course-box", "the 30 triangles of a course's Cornell box, side 555, front open",
       make_course_box},
      {"rooms", "rooms:n=2,door=0.3,closed=0,reflectance=0.5",
       "a chain of n unit rooms joined by square doors; closed=k shuts the door behind room k (S1, G7)",
       make_rooms},
      {"keyhole", "keyhole:width=0.02,height=0.1,reflectance=0.5",
       "two unit rooms joined by a small hole (Z1)", make_keyhole},
      {"disconnected-rooms", "disconnected-rooms:n=2,reflectance=0.5",
       "n closed rooms that do not see each other (G7)", make_disconnected_rooms},
      {"l-room", "l-room:reflectance=0.5", "an L-shaped room, lit at one end", make_l_room},
      {"clutter", "clutter:boxes=12,seed=1,reflectance=0.73",
       "unit cube with a red and a green wall and floating boxes", make_clutter},
      {"patio", "patio:sky=open",
       "two storeys of arcades around a court, 16 lamps; 24128 patches are squares", make_patio},
      {"colonnade", "colonnade:sky=open",
       "two rows of columns along red and blue cloth, open above, 2 lamps (document 000, Figure 13)",
       make_colonnade},
      {"sphere-cavity", "sphere-cavity:rings=12,reflectance=0.5",
       "inside of a faceted sphere, the top emits (E2)", make_sphere_cavity},
      {"bowl", "bowl:beta=60,rings=8,reflectance=0.5",
       "inside of a spherical bowl of half-angle beta degrees, open, its bottom emits (E2)", make_bowl},
      {"open-box", "open-box:reflectance=0.5", "the cube without its ceiling, the floor emits (G8)",
       make_open_box},
      {"wedge", "wedge:angle=90,reflectance=0.5",
       "two unit squares that share an edge at 1 to 179 degrees (G3)", make_wedge},
      {"facing-plates", "facing-plates:distance=1,reflectance=0.5",
       "two unit squares that see only each other: no closure exists (K1)", make_facing_plates},
      {"isolated-patch", "isolated-patch:reflectance=0.5",
       "the open box and a square that sees nothing: rows of zeros (G8, K1)", make_isolated_patch},
      {"flat", "flat:reflectance=0.5", "one triangle: F = 0 for exactly as many patches as wanted (G8)",
       make_flat},
      {"slivers", "slivers:aspect=1e6,reflectance=0.5", "the cube with strips of aspect 1000 and more (G4)",
       make_slivers},
      {"flawed-room", "flawed-room:reflectance=0.5",
       "the cube with a zero-area, a duplicate, a non-manifold and a flipped face (G4)", make_flawed_room},
      {"uneven-areas", "uneven-areas",
       "nested cubes, faces of 1e-6 to 1e6 m^2, reflectances of 0.01 to 0.999 (R3)", make_uneven_areas},
  };
  return scenes;
}

bool names_built_in_scene(const std::string& spec) {
  const std::string name = spec.substr(0, spec.find(':'));
  const std::vector<BuiltInScene>& scenes = built_in_scenes();
  return std::any_of(scenes.begin(), scenes.end(),
                     [&](const BuiltInScene& scene) { return scene.name == name; });
}

Scene built_in_scene(const std::string& spec_text) {
  Spec spec = Spec::parse(spec_text);
  std::string known;
  for (const BuiltInScene& scene : built_in_scenes()) {
    known += (known.empty() ? "" : ", ") + scene.name;
    if (scene.name != spec.name()) continue;
    Scene made = scene.make(spec);
    spec.finish();
    made.name = spec_text;
    return made;
  }
  fail<UsageError>("there is no built-in scene '{}'; the known ones are {}", spec.name(), known);
}

std::string room_of_group(const std::string& group) {
  return group.substr(0, group.find('/'));
}

}  // namespace radiosity

#pragma once

#include "foundation/spec.hpp"
#include "scene/scene.hpp"

namespace radiosity {

/// The makers behind built_in_scenes(). Each takes its keys from the spec; lengths are in metres. All but the
/// Cornell boxes and the course's box are grey with the key reflectance= (0 to 1), and what is named light
/// emits 1 W/m^2.

Scene make_cube(Spec& spec);
Scene make_cornell_box(Spec& spec);
Scene make_closed_cornell_box(Spec& spec);
Scene make_course_box(Spec& spec);

/// n (1 to 64) rooms of side 1 along x, with walls of thickness 0.05 between them. A door is a square opening
/// of side door (0, or 0.001 to 1) that stands on the floor in the middle of its wall; 0 walls up all doors,
/// closed=k only the one behind room k. Groups: room1/floor, room1/ceiling, room1/walls, room1/door (the four
/// sides of the opening behind room 1), room2/floor, ... The ceiling of the first room emits. Watertight.
Scene make_rooms(Spec& spec);

/// rooms:n=2 with an opening width x height (0.001 to 1) in the centre of the wall: room1/keyhole.
Scene make_keyhole(Spec& spec);

/// rooms:door=0: n closed cubes that do not see each other.
Scene make_disconnected_rooms(Spec& spec);

/// Two corridors that meet at a right angle, 2.2 x 0.9 x 2; groups floor, ceiling, walls and light, which is
/// the ceiling at one end. The other end does not see it. Watertight.
Scene make_l_room(Spec& spec);

/// The unit cube with a red wall on the left, a green one on the right, and so many floating boxes (0 to 100)
/// turned about the vertical, disjoint and apart from the walls, drawn from the seed; groups floor ... front
/// and box1, box2, ...; reflectance= is that of all other surfaces. Watertight.
Scene make_clutter(Spec& spec);

/// Two storeys of galleries around a square court (document 004, figure 4): 15.5 x 8.75 x 15.5, on each side
/// of the court three bays between square pillars, and parapets above. Groups: court, and of ground/ and
/// upper/ the floor, ceiling, walls, pillars and lintels (what carries the floor or roof above, seen from the
/// court), upper/parapets, and lamp1 to lamp16 in the ceilings of the galleries, which emit (1 to 8 on the
/// ground, two a side). All lengths are multiples of 1/4 and the area is 1508 m^2: 24128 patches are squares
/// of that side. The sky is open; sky=closed spans a canopy over the court (group sky), and it is watertight.
Scene make_patio(Spec& spec);

/// A nave between two rows of square columns and two aisles (after the picture of document 000, Figure 13):
/// 12 x 4.75 x 8.5, each row of four columns 0.5 thick and 4 high, under a lintel. Groups: column1 to column4
/// on the left, column5 to column8 on the right, lintels, floor, ceiling, ends, and of left/ and right/ the
/// wall, the cloth on its lower part, one a bay, red on the left and blue on the right, and the lamp in the
/// ceiling of the aisle, which emits. The sky is open above the nave; sky=closed spans a canopy over it
/// (group sky), and it is watertight.
Scene make_colonnade(Spec& spec);

/// The inside of a unit sphere as 2 rings^2 facets in rings (3 to 64) of trapezoids, the corners on the
/// sphere, where F_ij = A_j / A (hard case E2; the facets come near with 1 / rings^2); the upper quarter of
/// the rings is the group light, the rest wall. Watertight.
Scene make_sphere_cavity(Spec& spec);

/// The inside of the cap of a unit sphere around its lowest point with half-angle beta (1 to 179 degrees), in
/// rings (2 to 64); the innermost quarter of the rings is the group light, the rest dark. Open.
Scene make_bowl(Spec& spec);

/// Two unit squares, floor and light, that share an edge at an angle of 1 to 179 degrees.
Scene make_wedge(Spec& spec);

/// Two unit squares at a distance (0.001 to 1000) that face each other: light and plate.
Scene make_facing_plates(Spec& spec);

/// The cube without its ceiling; the floor emits.
Scene make_open_box(Spec& spec);

/// The open box and under it the unit square "isolated" that sees nothing, is not seen, and emits.
Scene make_isolated_patch(Spec& spec);

/// One triangle alone: F = 0. Cut into any number of patches exactly.
Scene make_flat(Spec& spec);

/// The cube with its floor, ceiling and two walls cut into strips, of which one has aspect 1000 and one
/// `aspect` (1 to 1e6): group slivers. Watertight.
Scene make_slivers(Spec& spec);

/// The cube with what faulty files contain: a triangle without area (group zero-area), the floor twice
/// (duplicate), a third face at an edge (fin) and a wall that faces outwards (flipped).
Scene make_flawed_room(Spec& spec);

/// Cubes of sides 1e-3, 1e-2, ..., 1e2 nested around the centre of a room of side 1e3: faces of 1e-6 to
/// 1e6 m^2. Reflectances from 0.01 (the smallest cube) to 0.999 (the walls). Watertight.
Scene make_uneven_areas(Spec& spec);

}  // namespace radiosity

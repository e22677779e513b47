#pragma once

#include "scene/polygon.hpp"

#include <vector>

namespace radiosity {

/// Convex polygons that cover parts of the faces of a scene, so that these parts are not surfaces: one list a
/// face, each polygon counter-clockwise seen from the face's front.
using Covers = std::vector<std::vector<Polygon>>;

/// A face is covered by what stands on it: the loop that the ends of other faces form in its plane (a block
/// without a bottom), or a face in the same plane that looks the opposite way and belongs to a body on its
/// front (a block with a bottom: the overlap is covered on both). A face and its reversed twin are a sheet,
/// not a contact.
Covers find_contacts(const Scene& scene);

/// How far from a line or plane a point of the scene still counts as on it.
double contact_tolerance(const Scene& scene);

/// A convex piece of a face with the covered parts left out, as convex polygons.
std::vector<Polygon> uncovered(const Polygon& piece, const std::vector<Polygon>& covers,
                               const Vector3& normal, double tolerance);

/// The scene with the covered parts of its faces left out; what remains of a face is cut into convex
/// triangles and quads of the same material and group. Faces without contact stay as they are. The result has
/// Contacts::never.
Scene without_contacts(const Scene& scene);

}  // namespace radiosity

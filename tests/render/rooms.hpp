#pragma once

#include "scene/patch_mesh.hpp"

#include <memory>

namespace radiosity::test {

/// The six walls of a room [0, size]^3 with fronts inwards; each wall is a group and a material of its own:
/// left, right, floor, ceiling, back (z = 0), front. Reflectance 0.5, no emission.
Scene box_room(const Vector3& size);

/// An inwards facing geodesic sphere of 20 x 4^level triangles about the origin, one group and material.
Scene sphere_room(int level);

/// A unit square at height z with its front up or down, as its own group and material; added to `scene`.
void add_square(Scene& scene, double z, bool front_up, double emission, double reflectance);

/// Every patch reflects and emits alike, in one channel.
void make_furnace(PatchMesh& mesh, double reflectance, double emission);

/// Area-weighted mean of a one-channel field over a group.
double group_mean(const PatchMesh& mesh, int group, const Eigen::MatrixXd& field);

}  // namespace radiosity::test

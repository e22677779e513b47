#pragma once

#include "scene/scene.hpp"

#include <vector>

namespace radiosity {

/// A directed edge of a face between two different (welded) vertices.
struct HalfEdge {
  int from = 0;
  int to = 0;
  int face = 0;
  int next = 0;   ///< the following half edge of the same face
  int twin = -1;  ///< the half edge that runs the opposite way in a neighbour; -1 where the face ends
};

/// The half edges of all faces with at least three different corners. Where more than two faces meet in an
/// edge, opposite half edges are paired in face order. (A half-edge mesh library would refuse such edges;
/// scanned and modelled scenes have them.)
std::vector<HalfEdge> half_edges(const Scene& scene, const std::vector<int>& welded);

/// The closed loops along which faces end, each a list of half edges (the `to` of each is the `from` of the
/// following).
std::vector<std::vector<int>> boundary_loops(const std::vector<HalfEdge>& edges);

}  // namespace radiosity

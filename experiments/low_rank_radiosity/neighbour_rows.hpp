#pragma once

#include "form_factors/form_factors.hpp"
#include "form_factors/scene_views.hpp"
#include "scene/patch_mesh.hpp"

#include <vector>

namespace radiosity {

/// Two patches next to each other on one face, and how much alike they see the scene.
struct NeighbourPair {
  Index first = 0;
  Index second = 0;
  double view_difference =
      0;  ///< of the scene views from their middles, 0 to 1 (form_factors/scene_views.hpp)
  double row_difference = 0;  ///< ||F_i - F_j|| / max(||F_i||, ||F_j||) of their rows of F
  double redirected = 0;      ///< sum_k |F_ik - F_jk| / 2: the part of their light that goes elsewhere
};

/// Each patch with the nearest other one of its face, every pair once, by rising row_difference. Patches
/// alone on their face have none.
std::vector<NeighbourPair> neighbouring_pairs(const FormFactors& form_factors, const SceneViews& views);

/// Spearman's rank correlation of two lists of one length, -1 to 1; equal values share their mean rank, and
/// it is 0 where one list is constant.
double rank_correlation(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace radiosity

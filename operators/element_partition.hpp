#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/spec.hpp"
#include "scene/coarse_mesh.hpp"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// The n elements of a scene in k patches, as V of the two-mesh method needs them (document 004,
/// section 4.1).
class ElementPartition {
 public:
  /// patch_of_element: P(e), n numbers 0 ... k - 1 of which each is there; area: n.
  ElementPartition(std::vector<int> patch_of_element, const Eigen::VectorXd& area);

  Index elements() const { return static_cast<Index>(patch_of_element_.size()); }
  Index patches() const { return patch_area_.size(); }
  const std::vector<int>& patch_of_element() const { return patch_of_element_; }

  /// The elements sorted by patch, those of one patch in the order of the mesh: n. The document's I are the
  /// k + 1 offsets: patch p has the sorted places offsets[p] ... offsets[p + 1] - 1.
  const std::vector<Index>& order() const { return order_; }
  const std::vector<Index>& offsets() const { return offsets_; }

  /// Sum of the areas of a patch's elements: k.
  const Eigen::VectorXd& patch_area() const { return patch_area_; }

  /// Whether the elements of each patch are equal in area (to 1e-12): V then is 1 where it is not 0.
  bool equal_areas() const { return equal_areas_; }

 private:
  std::vector<int> patch_of_element_;
  std::vector<Index> order_;
  std::vector<Index> offsets_;
  Eigen::VectorXd patch_area_;
  bool equal_areas_ = true;
};

/// Which coarse mesh a spec asks for: k=64, mesh=adaptive|uniform, assign=inclusion|proximity, and for
/// adaptive threshold= and least-area= (form_factors/coherent_mesh.hpp).
struct PartitionChoice {
  Index patches = 64;
  bool adaptive = true;
  Assignment assignment = Assignment::inclusion;
  double threshold = 0;
  double least_area = 0;
  std::string text;  ///< the keys

  static PartitionChoice take(Spec& spec);
};

/// The coarse mesh; empty where there is none of at most k patches (scene/coarse_mesh.hpp).
std::optional<CoarseMesh> make_coarse_mesh(const PatchMesh& elements, const PartitionChoice& choice);

struct ChosenPartition {
  ElementPartition partition;
  std::string remark;  ///< where no coarse mesh of at most k patches exists: what was done; else empty
};

/// The elements by their patch of the coarse mesh. Where the faces alone are more than k, or nothing is known
/// of the scene, k compact sets of elements that are near each other and face alike take the patches' place.
ChosenPartition choose_partition(const FormFactors& form_factors, const PartitionChoice& choice);

}  // namespace radiosity

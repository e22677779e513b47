#pragma once

#include "form_factors/form_factors.hpp"
#include "foundation/spec.hpp"
#include "kernels/segments.hpp"
#include "scene/coarse_mesh.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// The n elements of a scene in k patches (document 004, section 3.2).
class ElementPartition {
 public:
  /// patch_of_element: P(e), n numbers 0 ... k - 1 of which each is there; area: n.
  ElementPartition(std::vector<std::int32_t> patch_of_element, Eigen::VectorXd area);

  Index elements() const { return element_area_.size(); }
  Index patches() const { return patch_area_.size(); }
  const std::vector<std::int32_t>& patch_of_element() const { return patch_of_element_; }

  /// A_e, n, and the sums over the elements of each patch, k.
  const Eigen::VectorXd& element_area() const { return element_area_; }
  const Eigen::VectorXd& patch_area() const { return patch_area_; }

  /// Whether the elements of each patch are equal in area (to 1e-12): V then is 1 where it is not 0.
  bool equal_areas() const { return equal_areas_; }

  /// What U is divided by: c_p, the number of elements, where areas are equal, else A_p. k.
  Eigen::VectorXd divisors() const;

  /// V: 1 or A_e in the column of each element's patch (Equation 6, and its form for unequal areas).
  Segments right_factor() const;

  /// W: (A_e / A_p)^{1/2}, whose columns have length 1.
  Segments orthonormal_indicators() const;

 private:
  Segments sorted(const std::vector<double>& weights) const;

  std::vector<std::int32_t> patch_of_element_;
  Eigen::VectorXd element_area_;
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
  std::string text;  ///< the keys but k

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

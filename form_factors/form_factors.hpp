#pragma once

#include "foundation/monitor.hpp"
#include "kernels/row_major_matrix.hpp"
#include "kernels/symmetric_tiles.hpp"
#include "scene/patch_mesh.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace radiosity {

/// How the form factors of a scene came about and how good they are (keys of the JSON's "form_factors").
struct FormFactorQuality {
  std::string method;   ///< accurate, one-ray or gather
  std::string closure;  ///< none, symmetric, or energy-removing where symmetric scaling does not exist
  std::uint64_t rays = 0;
  double seconds = 0;
  double cpu_seconds = 0;
  double row_sum_min = 0;  ///< of sum_j F_ij over live patches, after the closure
  double row_sum_max = 0;
  double row_sum_rms = 0;        ///< root mean square of sum_j F_ij - exposed fraction, over live patches
  double reciprocity_max = 0;    ///< max |A_i F_ij - A_j F_ji| / max(A_i F_ij, A_j F_ji)
  std::uint64_t back_hits = 0;   ///< probe rays that ended on the back of a face
  std::uint64_t leaks = 0;       ///< probe rays that left an enclosure
  std::uint64_t probe_rays = 0;  ///< cosine-weighted rays from every patch behind the two counts
  std::string closure_note;      ///< why the closure asked for was not used; empty otherwise
};

/// F of a scene, assembled: reciprocity makes K = A^{1/2} F A^{-1/2} symmetric, K_ij = A_i F_ij / sqrt(A_i
/// A_j), so that one albedo-free kernel serves every colour and reflectance; T = R A^{-1/2} K A^{1/2}. Only
/// `gather` has no such K: its F is kept as a full matrix.
struct FormFactors {
  std::shared_ptr<const PatchMesh> mesh;
  std::shared_ptr<const SymmetricTiles<double>> kernel;       ///< K; null for gather
  std::shared_ptr<const RowMajorMatrix<double>> unsymmetric;  ///< F itself; null unless gather
  Eigen::VectorXd exposed;  ///< n, fraction of the hemisphere of each patch that ends on fronts; 0 marks a
                            ///< patch that is not live
  FormFactorQuality quality;
  /// groups x groups: estimated standard error of each F between groups, before a closure; empty if not
  /// known.
  Eigen::MatrixXd group_standard_error;

  Index patch_count() const { return mesh->patch_count(); }
  bool symmetric() const { return kernel != nullptr; }

  /// F_ij, the fraction of what leaves i and arrives at j.
  double operator()(Index i, Index j) const;

  /// sum_j F_ij, n.
  Eigen::VectorXd row_sums() const;

  /// The full matrix F, n x n: for small n, tests and export.
  Eigen::MatrixXd matrix() const;
};

enum class FormFactorMethod { accurate, one_ray, gather };
enum class Closure { automatic, none, symmetric };

struct FormFactorOptions {
  FormFactorMethod method = FormFactorMethod::accurate;
  double tolerance = 1e-4;  ///< estimated standard error of each F_ij and of each F between groups
  Closure closure = Closure::automatic;  ///< automatic: symmetric where the scene is an enclosure, else none
  std::uint64_t seed = 1;
  int gather_rays = 1024;  ///< cosine-weighted rays a patch, for gather
};

/// Assembles F of all patches. The result depends on the seed but not on the number of threads.
FormFactors compute_form_factors(std::shared_ptr<const PatchMesh> mesh, const FormFactorOptions& options,
                                 Monitor& monitor);

}  // namespace radiosity

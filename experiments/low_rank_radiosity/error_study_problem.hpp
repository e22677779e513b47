#pragma once

#include "experiments/lights.hpp"
#include "experiments/low_rank_radiosity/error_study.hpp"
#include "form_factors/form_factors.hpp"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// One scene: what does not depend on reflectances.
struct StudiedScene {
  std::string name;
  FormFactors form_factors;
  Eigen::MatrixXd kernel;       ///< K
  Eigen::VectorXd kernel_rows;  ///< squared lengths of its rows
  std::vector<Index> ranks;
};

/// One scene with one set of reflectances, and its lights solved.
struct StudiedProblem {
  ErrorStudyProblem problem;
  FormFactors form_factors;
  LightSet lights;
  Field radiosity;

  const PatchMesh& mesh() const { return *form_factors.mesh; }
};

/// Cuts a built-in scene into patches and assembles its form factors.
StudiedScene make_studied_scene(const std::string& name, const ErrorStudyOptions& options, Monitor& monitor);

/// The scene in its own colours or in one grey, with the lights of the study and their radiosity.
StudiedProblem make_studied_problem(const StudiedScene& scene, std::optional<double> reflectance,
                                    const ErrorStudyOptions& options, Monitor& monitor);

}  // namespace radiosity

#include "experiments/low_rank_radiosity/error_study_problem.hpp"

#include "experiments/low_rank_radiosity/error_study_measures.hpp"
#include "scene/built_in.hpp"

#include <memory>
#include <utility>

namespace radiosity {
namespace {

FormFactors with_grey(const FormFactors& form_factors, std::optional<double> reflectance) {
  if (!reflectance) return form_factors;
  FormFactors changed = form_factors;
  auto mesh = std::make_shared<PatchMesh>(*form_factors.mesh);
  mesh->reflectance = Eigen::MatrixXd::Constant(mesh->patch_count(), 1, *reflectance);
  mesh->emission = Eigen::MatrixXd::Zero(mesh->patch_count(), 1);
  changed.mesh = std::move(mesh);
  return changed;
}

}  // namespace

StudiedScene make_studied_scene(const std::string& name, const ErrorStudyOptions& options, Monitor& monitor) {
  const auto mesh =
      std::make_shared<const PatchMesh>(make_patches(built_in_scene(name), {.patches = options.patches}));
  FormFactors form_factors = compute_form_factors(mesh, {.seed = options.seed}, monitor);
  Eigen::MatrixXd kernel = materialize(*form_factors.kernel);
  Eigen::VectorXd rows = kernel.rowwise().squaredNorm();
  return {name, std::move(form_factors), std::move(kernel), std::move(rows),
          studied_ranks(mesh->patch_count(), options)};
}

StudiedProblem make_studied_problem(const StudiedScene& scene, std::optional<double> reflectance,
                                    const ErrorStudyOptions& options, Monitor& monitor) {
  StudiedProblem made;
  made.problem = {scene.name, scene.form_factors.patch_count(), reflectance};
  made.form_factors = with_grey(scene.form_factors, reflectance);
  made.lights = draw_lights(made.mesh(), options.lights, options.seed, monitor);
  made.radiosity = solve_densely(scene.kernel, made.mesh(), made.lights.emission);
  return made;
}

}  // namespace radiosity

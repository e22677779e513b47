#include "experiments/low_rank_radiosity/coherence_pictures.hpp"

#include "experiments/json_objects.hpp"
#include "experiments/low_rank_radiosity/patch_drawing.hpp"
#include "experiments/low_rank_radiosity/patch_view.hpp"
#include "experiments/reference_solution.hpp"
#include "form_factors/coherent_mesh.hpp"
#include "foundation/error.hpp"
#include "foundation/output_file.hpp"
#include "foundation/parallel.hpp"
#include "render/tone_mapping.hpp"
#include "scene/built_in.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <utility>

namespace radiosity {
namespace {

Eigen::VectorXd incoherence_of_patches(const PatchMesh& mesh, const CoherencePictureOptions& options,
                                       Monitor& monitor) {
  const SceneViews views(mesh, options.directions, options.seed);
  Eigen::VectorXd incoherence(mesh.patch_count());
  std::atomic<Index> done{0};
  parallel_for(static_cast<std::size_t>(mesh.patch_count()), [&](std::size_t i) {
    const auto patch = static_cast<Index>(i);
    incoherence[patch] = views.incoherence(polygon_of(mesh, patch));
    monitor.checkpoint("scene views", static_cast<double>(++done) / static_cast<double>(mesh.patch_count()));
  });
  return incoherence;
}

/// White where views do not vary, black where they vary most.
Eigen::MatrixXd coherence_colours(const Eigen::VectorXd& incoherence) {
  const double most = incoherence.size() > 0 ? incoherence.maxCoeff() : 0;
  Eigen::MatrixXd colours = Eigen::MatrixXd::Ones(incoherence.size(), 3);
  if (most > 0) colours.colwise() -= incoherence / most;
  // Grey levels as the eye takes them: linear light falls as the square of what is seen.
  return colours.cwiseAbs2();
}

void write_views(const std::filesystem::path& file, const CoherenceMeasurement& measurement,
                 const NeighbourPair& pair, int size, Monitor& monitor) {
  const PatchMesh& mesh = *measurement.form_factors.mesh;
  const PatchRays rays(mesh);
  const double exposure = exposure_of(measurement.radiosity, mesh.area);
  write_drawing(
      file,
      side_by_side({draw_view(mesh, rays, pair.first, measurement.radiosity, exposure, size, monitor),
                    draw_view(mesh, rays, pair.second, measurement.radiosity, exposure, size, monitor)}));
}

void write_meshes(const std::filesystem::path& file, const CoherenceMeasurement& measurement, int size,
                  Monitor& monitor) {
  std::vector<Picture> pictures;
  for (const PatchMesh* mesh : {&measurement.largest, &measurement.coarse.patches, measurement.fine.get()}) {
    constexpr double thick = 1, thin = 0.67;
    const double line = mesh == measurement.fine.get() ? thin : thick;
    pictures.push_back(draw_patches(*mesh, shaded_reflectance(*mesh), {size, size, line}, monitor));
  }
  write_drawing(file, side_by_side(pictures));
}

Json pair_json(const NeighbourPair& pair) {
  return {{"patches", {pair.first, pair.second}},
          {"view_difference", pair.view_difference},
          {"row_difference", pair.row_difference},
          {"redirected", pair.redirected}};
}

void write_coherence_json(const std::filesystem::path& file, const CoherenceMeasurement& measurement) {
  Json pairs = Json::array();
  for (const NeighbourPair& pair : measurement.pairs) pairs.push_back(pair_json(pair));
  write_json(
      file,
      {{"views", {{"scene", scene_json(*measurement.form_factors.mesh)}, {"pairs", pairs}}},
       {"coherence",
        {{"scene", scene_json(*measurement.fine)}, {"incoherence", numbers_json(measurement.incoherence)}}},
       {"meshes",
        {{"start", measurement.largest.patch_count()},
         {"coarse", measurement.coarse.patches.patch_count()},
         {"fine", measurement.fine->patch_count()}}}});
}

}  // namespace

Eigen::VectorXd CoherenceMeasurement::area_of_coarse_patch() const {
  Eigen::VectorXd area(fine->patch_count());
  for (Index e = 0; e < area.size(); ++e)
    area[e] = coarse.patches.area[coarse.patch_of_element[static_cast<std::size_t>(e)]];
  return area;
}

CoherenceMeasurement measure_coherence(const CoherencePictureOptions& options, Monitor& monitor) {
  const Scene scene = built_in_scene(options.scene);
  const auto mesh = std::make_shared<const PatchMesh>(make_patches(scene, {.patches = options.view_patches}));
  CoherenceMeasurement measurement;
  measurement.form_factors = compute_form_factors(mesh, {.seed = options.seed}, monitor);
  std::optional<Field> radiosity = reference_solution(measurement.form_factors, mesh->emission);
  if (!radiosity) fail("no solver finds the radiosity of {}", options.scene);
  measurement.radiosity = std::move(*radiosity);
  measurement.pairs =
      neighbouring_pairs(measurement.form_factors, SceneViews(*mesh, options.directions, options.seed));
  if (measurement.pairs.empty())
    fail<UsageError>("no face of {} has two of its {} patches: ask for more", options.scene,
                     mesh->patch_count());

  measurement.fine =
      std::make_shared<const PatchMesh>(make_patches(scene, {.patches = options.fine_patches}));
  measurement.incoherence = incoherence_of_patches(*measurement.fine, options, monitor);
  measurement.largest = coarsest_patches(*measurement.fine);
  std::optional<CoarseMesh> coarse =
      coherent_coarse_mesh(*measurement.fine, options.coarse_patches, Assignment::inclusion,
                           {.directions = options.directions, .seed = options.seed});
  if (!coarse)
    fail<UsageError>("{} has more than {} faces: a coarse mesh needs as many patches at least", options.scene,
                     options.coarse_patches);
  measurement.coarse = std::move(*coarse);
  return measurement;
}

ReportSection low_rank_pictures(const std::filesystem::path& folder, const std::string& command,
                                const CoherencePictureOptions& options, Monitor& monitor) {
  make_folder(folder);

  const CoherenceMeasurement measurement = measure_coherence(options, monitor);
  write_coherence_json(folder / "low_rank_pictures.json", measurement);
  const CoherenceFiles files{folder / "low_rank_views.png", folder / "low_rank_views_extreme.png",
                             folder / "low_rank_coherence.png", folder / "low_rank_meshes.png"};
  const int size = options.picture_size;
  write_views(files.typical_views, measurement, measurement.typical_pair(), size, monitor);
  write_views(files.extreme_views, measurement, measurement.extreme_pair(), size, monitor);
  write_drawing(files.coherence, draw_patches(*measurement.fine, coherence_colours(measurement.incoherence),
                                              {.width = size, .height = size, .line_width = 0}, monitor));
  write_meshes(files.meshes, measurement, size, monitor);
  return coherence_section(measurement, files, command);
}

}  // namespace radiosity

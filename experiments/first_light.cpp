#include "experiments/first_light.hpp"

#include "experiments/first_light_files.hpp"
#include "foundation/output_file.hpp"
#include "render/write_solution.hpp"

namespace radiosity {

ReportSection first_light(const std::filesystem::path& folder, const std::string& command,
                          const FirstLightOptions& options, const OperatorRegistry& operators,
                          const SolverRegistry& solvers, Monitor& monitor) {
  make_folder(folder);

  const FirstLightMeasurement measurement = measure_first_light(options, operators, solvers, monitor);
  write_first_light_json(folder / "first_light.json", measurement);
  write_first_light_csv(folder / "first_light.csv", measurement);

  const FirstLightSize& finest = measurement.sizes.back();
  ReportSection section = first_light_section(measurement, command);
  std::vector<ReportBlock> pictures;
  for (const bool interpolate : {true, false}) {
    const auto file = folder / (interpolate ? "first_light_smooth.png" : "first_light_flat.png");
    PictureOptions picture;
    picture.width = options.picture_size;
    picture.height = options.picture_size;
    picture.interpolate = interpolate;
    write_solution(file, *finest.mesh, finest.radiosity, picture, monitor);
    const std::string shading = interpolate ? "interpolated between the corners of patches that share a plane"
                                            : "one colour a patch, as it was computed";
    pictures.emplace_back(png_figure(
        file, fmt::format("{} with {} patches, {}.", options.scene, finest.mesh->patch_count(), shading),
        command));
  }
  section.blocks.insert(section.blocks.begin() + 1, pictures.begin(), pictures.end());
  return section;
}

}  // namespace radiosity

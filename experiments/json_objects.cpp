#include "experiments/json_objects.hpp"

#include "foundation/output_file.hpp"

#include <nlohmann/json.hpp>

#include <vector>

namespace radiosity {

std::size_t triangle_count(const Scene& scene) {
  std::size_t count = 0;
  for (const Face& face : scene.faces) count += face.corner_count == 4 ? 2 : 1;
  return count;
}

Json or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
}

Json certificate_json(const std::optional<CertificateSummary>& certificate) {
  if (!certificate) return {};
  return {{"bound", or_null(certificate->bound)},        {"kind", certificate->kind},
          {"confidence", certificate->confidence},       {"vectors", certificate->vectors},
          {"products", certificate->products},           {"ratio_min", or_null(certificate->ratio_min)},
          {"ratio_max", or_null(certificate->ratio_max)}};
}

Json scene_json(const PatchMesh& mesh) {
  return {{"name", mesh.scene->name},       {"triangles", triangle_count(*mesh.scene)},
          {"patches", mesh.patch_count()},  {"channels", mesh.channels()},
          {"closed", mesh.topology.closed}, {"area", mesh.area.sum()}};
}

Json machine_json(const Machine& machine) {
  return {{"cpu", machine.cpu},
          {"threads", machine.threads},
          {"read_bandwidth_gb_s", machine.read_bandwidth_gb_s},
          {"load", machine.load}};
}

Json form_factors_json(const FormFactorQuality& quality) {
  const bool timed = quality.rays > 0 && quality.seconds > 0;
  return {{"method", quality.method},
          {"closure", quality.closure},
          {"rays", quality.rays},
          {"seconds", quality.seconds},
          {"cpu_seconds", quality.cpu_seconds},
          {"rays_per_second", timed ? Json(static_cast<double>(quality.rays) / quality.seconds) : Json()},
          {"row_sum_min", quality.row_sum_min},
          {"row_sum_max", quality.row_sum_max},
          {"row_sum_rms", quality.row_sum_rms},
          {"reciprocity_max", quality.reciprocity_max},
          {"back_hits", quality.back_hits},
          {"leaks", quality.leaks}};
}

Json numbers_json(const Eigen::VectorXd& values) {
  return std::vector<double>(values.begin(), values.end());
}

Json matrix_json(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Index i = 0; i < matrix.rows(); ++i) rows.push_back(numbers_json(matrix.row(i)));
  return rows;
}

std::string device_name(const std::optional<DeviceUse>& use) {
  return use ? use->name : "cpu";
}

Json renderer_json(const std::optional<DeviceUse>& use) {
  return use ? Json(use->renderer) : Json();
}

Json device_difference_json(const std::optional<DeviceUse>& use) {
  return use ? Json(use->difference_max) : Json();
}

void write_json(const std::filesystem::path& file, const Json& value) {
  OutputFile output(file);
  output.stream() << value.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  output.commit();
}

}  // namespace radiosity

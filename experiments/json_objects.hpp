#pragma once

#include "experiments/certification.hpp"
#include "experiments/machine.hpp"
#include "form_factors/form_factors.hpp"
#include "operators/linear_operator.hpp"
#include "scene/patch_mesh.hpp"

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace radiosity {

using Json = nlohmann::ordered_json;

/// Triangles of the coarse faces; a quad counts as two.
std::size_t triangle_count(const Scene& scene);

/// Null for a value that does not exist.
Json or_null(const std::optional<double>& value);

/// The "scene" object of every JSON file: name, triangles, patches, channels, closed, area.
Json scene_json(const PatchMesh& mesh);

/// The "machine" object of every JSON file: cpu, threads, read_bandwidth_gb_s, load.
Json machine_json(const Machine& machine);

/// The "form_factors" object of every JSON file.
Json form_factors_json(const FormFactorQuality& quality);

/// The "certificate" object of a result: bound, kind, confidence, vectors, products, ratio_min, ratio_max.
Json certificate_json(const std::optional<CertificateSummary>& certificate);

/// A list of numbers.
Json numbers_json(const Eigen::VectorXd& values);

/// A list of rows.
Json matrix_json(const Eigen::MatrixXd& matrix);

/// Writes a value, indented; the file appears whole or not at all.
void write_json(const std::filesystem::path& file, const Json& value);

/// What documents say of the device of an operator; "cpu", null and null without one.
std::string device_name(const std::optional<DeviceUse>& use);
Json renderer_json(const std::optional<DeviceUse>& use);
Json device_difference_json(const std::optional<DeviceUse>& use);

}  // namespace radiosity

#pragma once

#include "experiments/first_light_measurement.hpp"

#include <filesystem>

namespace radiosity {

/// The measurements as JSON: "scene" (name), "machine", "sizes": [{"scene", "raw_row_sum_rms", "accurate",
/// "one_ray", "operators", "referee"}]. Appears whole or not at all.
void write_first_light_json(const std::filesystem::path& file, const FirstLightMeasurement& measurement);

/// One line for each size and operator, and one for one-ray form factors. Appears whole or not at all.
void write_first_light_csv(const std::filesystem::path& file, const FirstLightMeasurement& measurement);

}  // namespace radiosity

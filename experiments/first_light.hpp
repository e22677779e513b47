#pragma once

#include "experiments/first_light_measurement.hpp"
#include "experiments/report.hpp"

#include <filesystem>

namespace radiosity {

/// First light: the closed Cornell box at several sizes. Accurate against one-ray form factors, dense against
/// csr operators, and radiosity against path tracing. Writes first_light.json, first_light.csv,
/// first_light_flat.png and first_light_smooth.png into `folder` (made if it is missing) and returns the
/// report's section about them. `command` is what the section names as its origin.
ReportSection first_light(const std::filesystem::path& folder, const std::string& command,
                          const FirstLightOptions& options, const OperatorRegistry& operators,
                          const SolverRegistry& solvers, Monitor& monitor);

/// The section about measurements that are already there, without the pictures.
ReportSection first_light_section(const FirstLightMeasurement& measurement, const std::string& command);

}  // namespace radiosity

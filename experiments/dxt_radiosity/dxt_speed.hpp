#pragma once

#include "experiments/comparison.hpp"
#include "experiments/device/device_results.hpp"
#include "experiments/dxt_radiosity/light_answers.hpp"
#include "experiments/report.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace radiosity {

/// Time and memory of document 000's method against the naive one, over patches and over bounces.
struct DxtSpeedOptions {
  std::string scene = "cornell-box-closed";
  std::vector<Index> patches = {400, 800, 1600};
  std::vector<Index> patches_beyond_cache = {};  ///< larger ones, of fewer methods: S_k takes O(n^3)
  long bounces = 3;
  Index patches_over_bounces = 800;  ///< of the times over k
  std::vector<long> bounce_counts = {1, 2, 3, 5, 10};
  LightCounts lights = {.area = 2, .point = 2, .patch = 2};  ///< of the errors; the first one is timed
  double seconds = 0.3;                                      ///< of timing, for each size and each k
  std::uint64_t seed = 1;
  std::shared_ptr<const DeviceResults> device;  ///< measured beside; null: none
};

/// A method at one n and k.
struct MethodSpeed {
  std::string name;
  std::size_t bytes = 0;
  Timing time;                             ///< of one light, all channels
  std::optional<double> error_of_bounces;  ///< mean in B, against k bounces of T; empty for all bounces
  double error = 0;                        ///< the same against B
};

/// Methods that took turns.
struct SpeedRound {
  Index patches = 0;
  Index channels = 0;
  long bounces = 0;
  double load = 0;  ///< of the machine afterwards
  Timing reading;   ///< 4 n^2 bytes once, as a plain sum reads them, in turns with the methods
  std::vector<MethodSpeed> methods;

  /// Throws Error where the method was not measured.
  const MethodSpeed& method(const std::string& name) const;
  /// Null where it was not.
  const MethodSpeed* find(const std::string& name) const;

  /// Bytes of a scalar F in float32, 4 n^2.
  double factor_bytes() const;
  /// How often the naive solver reads them: once a bounce and channel.
  double naive_reads() const { return static_cast<double>(bounces * channels); }
  /// Seconds to read so many bytes once at the rate of `reading`.
  double seconds_to_read(double bytes) const { return reading.min * bytes / factor_bytes(); }
};

struct DxtSpeeds {
  int threads = 0;
  std::vector<SpeedRound> over_patches;  ///< all methods, then, for larger n, those that are quickly built
  std::vector<SpeedRound> over_bounces;
};

/// Names of methods besides those of bounce_methods.hpp.
constexpr const char* float_sum = "sum, float32";
constexpr const char* document_sum = "sum, DXT";
constexpr const char* improved_sum = "sum, DXT improved";
constexpr const char* solved_kernel = "CG, BC4 kernel";

DxtSpeeds measure_dxt_speeds(const DxtSpeedOptions& options, const OperatorRegistry& operators,
                             const SolverRegistry& solvers, Monitor& monitor);

/// The sum of k bounces in DXT against the naive method at the largest n: times and bytes, and what is
/// wanted.
std::string dxt_speed_finding(const DxtSpeeds& speeds);
/// What reading alone takes at the largest n, and how far the naive solver and the compressed sum are from
/// it.
std::string reading_finding(const DxtSpeeds& speeds);
/// Who is faster for as good an answer, the improved sum or a solver, at the largest n that has both.
std::string solver_finding(const DxtSpeeds& speeds);

ReportSection dxt_speed_section(const DxtSpeeds& speeds, const DxtSpeedOptions& options,
                                const std::string& command);

/// dxt_speed.json and dxt_speed.csv; `device`: null or what the JSON names as "device".
void write_dxt_speeds(const std::filesystem::path& folder, const DxtSpeeds& speeds,
                      const DeviceResults* device = nullptr);

/// Measures, writes dxt_speed.json and .csv into `folder` (made if it is missing), returns the section.
ReportSection dxt_speed(const std::filesystem::path& folder, const std::string& command,
                        const DxtSpeedOptions& options, const OperatorRegistry& operators,
                        const SolverRegistry& solvers, Monitor& monitor);

}  // namespace radiosity

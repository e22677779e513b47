#include "experiments/comparison.hpp"

#include <fmt/format.h>

namespace radiosity {

namespace {

constexpr const char* row_format =
    "{:{}}  {:>9}  {:>9}  {:>9}  {:>9}  {:>8}  {:>9}  {:>9}  {:>9}  {:>9}  {:>12}\n";

std::string size_text(std::size_t bytes) {
  const double megabytes = 1e-6 * static_cast<double>(bytes);
  return fmt::format("{:.{}f}", megabytes, megabytes < 100 ? 2 : 0);
}

std::string time_text(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.1f} us", 1e6 * seconds);
  if (seconds < 1) return fmt::format("{:.2f} ms", 1e3 * seconds);
  return fmt::format("{:.2f} s", seconds);
}

std::string error_text(const std::optional<double>& error) {
  return error ? fmt::format("{:.2e}", *error) : "-";
}

std::string bound_text(const ComparisonResult& result) {
  return result.certificate ? error_text(result.certificate->bound) : "-";
}

/// Smallest and largest ratio over the lights.
std::string ratio_text(const ComparisonResult& result) {
  if (!result.certificate || !result.certificate->ratio_min) return "-";
  return fmt::format("{:.2f} - {:.2f}", *result.certificate->ratio_min, *result.certificate->ratio_max);
}

std::string device_text(const ComparisonResult& result) {
  const DeviceUse& device = *result.device;
  return fmt::format("{}: on {}{}, sent in {}, {} a product, at most {} from the CPU's\n", result.spec,
                     device.renderer,
                     device.software ? " (a software renderer, which computes on the CPU)" : "",
                     time_text(device.upload_seconds), time_text(result.device_apply_seconds),
                     error_text(device.difference_max));
}

}  // namespace

std::string comparison_table(const Comparison& comparison) {
  std::size_t width = 8;
  for (const ComparisonResult& result : comparison.results) width = std::max(width, result.spec.size());
  std::string table = fmt::format(row_format, "operator", width, "MB", "build", "apply", "solve", "products",
                                  "error T", "error B", "indirect", "bound B", "bound/actual");
  for (const ComparisonResult& result : comparison.results)
    table +=
        fmt::format(row_format, result.spec, width, size_text(result.bytes), time_text(result.build_seconds),
                    time_text(result.apply.min), time_text(result.solve.min), result.iterations,
                    error_text(result.errors.operator_frobenius), error_text(result.errors.radiosity_mean),
                    error_text(result.errors.indirect_mean), bound_text(result), ratio_text(result));
  for (const ComparisonResult& result : comparison.results)
    if (!result.remark.empty()) table += fmt::format("{}: {}\n", result.spec, result.remark);
  for (const ComparisonResult& result : comparison.results)
    if (result.device) table += device_text(result);
  return table;
}

}  // namespace radiosity

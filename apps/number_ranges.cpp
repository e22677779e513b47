#include "apps/number_ranges.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

namespace radiosity {
namespace {

template <typename Number>
std::optional<Number> parsed(const std::string& text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

CLI::Validator number_above(double low) {
  return CLI::Validator(
      [low](const std::string& text) -> std::string {
        const auto value = parsed<double>(text);
        if (value && std::isfinite(*value) && *value > low) return {};
        return fmt::format("'{}' is not a number above {}", text, low);
      },
      "NUMBER");
}

CLI::Validator number_between(double low, double high, bool high_allowed) {
  return CLI::Validator(
      [low, high, high_allowed](const std::string& text) -> std::string {
        const auto value = parsed<double>(text);
        if (value && *value >= low && (*value < high || (high_allowed && *value == high))) return {};
        return fmt::format("'{}' is not a number in [{}, {}{}", text, low, high, high_allowed ? "]" : ")");
      },
      "NUMBER");
}

CLI::Validator integer_between(long long low, long long high) {
  return CLI::Validator(
      [low, high](const std::string& text) -> std::string {
        const auto value = parsed<long long>(text);
        if (value && *value >= low && *value <= high) return {};
        return fmt::format("'{}' is not a whole number from {} to {}", text, low, high);
      },
      "COUNT");
}

}  // namespace radiosity

#include "operators/bounce_sums.hpp"

#include "factorizations/power_sums.hpp"
#include "foundation/error.hpp"

#include <charconv>

namespace radiosity {
namespace {

constexpr long most_bounces = 1000;

}  // namespace

BounceCount take_bounces(Spec& spec, const std::string& key, long fallback) {
  const std::string text = spec.text(key, std::to_string(fallback));
  if (text == "inf") return std::nullopt;
  long count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count < 1 || count > most_bounces)
    fail<UsageError>("'{}': {}={} is neither inf nor a number from 1 to {}", spec.text(), key, text,
                     most_bounces);
  return count;
}

std::string bounce_text(const BounceCount& bounces) {
  return bounces ? std::to_string(*bounces) : "inf";
}

double bounce_sum_bytes(Eigen::Index n, const BounceCount& bounces) {
  // F and the result; F R, F C, a power and what is being added to it.
  const double matrices = bounces == 1L ? 2 : 6;
  return matrices * sizeof(double) * static_cast<double>(n) * static_cast<double>(n);
}

Eigen::MatrixXd bounce_sum(const Eigen::MatrixXd& F, const Eigen::VectorXd& reflectance,
                           const Eigen::VectorXd& colours, const BounceCount& bounces) {
  if (bounces == 1L) return F * colours.asDiagonal();
  const Eigen::MatrixXd reflected = F * reflectance.asDiagonal();
  Eigen::MatrixXd first = F * colours.asDiagonal();
  return bounces ? power_sum(reflected, first, *bounces) : geometric_sum(reflected, std::move(first));
}

}  // namespace radiosity

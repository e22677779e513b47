#include "compression/log_map.hpp"

#include "foundation/error.hpp"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

constexpr double sums_per_unit = 16;

void require_largest(double largest) {
  if (!(std::isfinite(largest) && largest >= 0))
    fail<UsageError>("the largest value of a logarithmic map is {}; it must be finite and not negative",
                     largest);
}

}  // namespace

LogMap::LogMap(double largest, double range) : largest_(largest), range_(range) {
  require_largest(largest);
  if (!(std::isfinite(range) && range > 0))
    fail<UsageError>("the range of a logarithmic map is {}; it must be positive", range);
}

double LogMap::code(double value) const {
  if (!(value > 0) || largest_ == 0) return 0;
  // In this form the largest value's code is 255 without rounding.
  return std::clamp(largest_code + std::log(value / largest_) * (largest_code / range_), 0.0, largest_code);
}

double LogMap::value(double code) const {
  if (!(code > 0)) return 0;
  return std::exp((code / largest_code - 1) * range_) * largest_;
}

LogSums::LogSums(double largest) : largest_(largest) {
  require_largest(largest);
}

void LogSums::add(double value) {
  if (!(value >= 0 && value <= largest_))
    fail("a value of {} is not between 0 and the largest, {}, whose logarithms are summed", value, largest_);
  if (value == 0) return;
  // Not the logarithm of a quotient, which could overflow.
  const double below = std::max(std::log(largest_) - std::log(value), 0.0);
  const auto at = static_cast<std::size_t>(below * sums_per_unit);
  if (at >= sum_.size()) sum_.resize(at + 1);
  sum_[at] += value;
}

void LogSums::add(const LogSums& others) {
  if (others.largest_ != largest_)
    fail<UsageError>("sums below {} cannot be joined with sums below {}", largest_, others.largest_);
  if (others.sum_.size() > sum_.size()) sum_.resize(others.sum_.size());
  for (std::size_t k = 0; k < others.sum_.size(); ++k) sum_[k] += others.sum_[k];
}

double LogSums::range(double share) const {
  if (!(share >= 0 && share < 1))
    fail<UsageError>("a share of {} may lie below the range; it must be from 0 to below 1", share);
  double total = 0;
  for (auto sum = sum_.rbegin(); sum != sum_.rend(); ++sum) total += *sum;
  std::size_t steps = sum_.size();
  double below = 0;
  while (steps > 1 && below + sum_[steps - 1] <= share * total) below += sum_[--steps];
  return static_cast<double>(std::max<std::size_t>(steps, 1)) / sums_per_unit;
}

}  // namespace radiosity

#pragma once

#include <cstddef>
#include <vector>

namespace radiosity {

/// The logarithmic codes of document 000, section 3.5, for one channel of a non-negative matrix:
///
///   code = clamp((ln(value / largest) + range) 255 / range, 0, 255),
///
/// so that equal steps of the code are equal ratios of the values, e^(range / 255). The document has a range
/// of 25 and decodes code 0 to e^-25 largest; here code 0 means 0 exactly, and values up to e^-range largest
/// get it. Where codes are rounded to whole numbers, values up to e^(range (1/510 - 1)) largest do.
class LogMap {
 public:
  static constexpr double document_range = 25;
  static constexpr double largest_code = 255;

  /// Throws UsageError unless largest is >= 0 and range > 0, both finite.
  explicit LogMap(double largest, double range = document_range);

  /// In [0, 255], not rounded. value >= 0.
  double code(double value) const;
  /// In [0, largest]. 0 <= code <= 255, whole or not.
  double value(double code) const;

  double largest() const { return largest_; }
  double range() const { return range_; }

 private:
  double largest_;
  double range_;
};

/// Sums of values by how far they lie below the largest, from which follows the range that they span.
class LogSums {
 public:
  /// Throws UsageError unless largest is >= 0 and finite.
  explicit LogSums(double largest);

  /// Throws Error for values that are negative, NaN or above the largest.
  void add(double value);
  /// Adds those of others, of the same largest value: rows can be summed at once and then joined in order.
  void add(const LogSums& others);

  /// A range, in steps of 1/16 and at least that, such that what lies below e^-range largest is at most
  /// `share` of the sum of all values. Throws UsageError unless 0 <= share < 1.
  double range(double share) const;

 private:
  double largest_;
  std::vector<double> sum_;  ///< of the values e^(-k / 16) largest >= value > e^(-(k + 1) / 16) largest
};

}  // namespace radiosity

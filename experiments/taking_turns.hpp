#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace radiosity {

/// One of several pieces of work that are timed side by side.
struct Competitor {
  std::string name;
  std::ptrdiff_t columns = 1;
  std::size_t bytes = 0;  ///< of the matrices that it reads once
  std::function<void()> work;
  int turns = 1;                     ///< in each repetition
  std::vector<double> seconds = {};  ///< of each turn, after take_turns

  double seconds_min() const;
  double seconds_median() const;
  /// bytes / seconds_min, 1e9 bytes a second.
  double gigabytes_per_second() const;
};

/// Repeats all competitors one after the other until `seconds` are over, so that noise hits all alike.
/// Forgets earlier timings. Returns the number of repetitions, at least 1.
int take_turns(std::vector<Competitor>& competitors, double seconds);

}  // namespace radiosity

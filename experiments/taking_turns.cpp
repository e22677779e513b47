#include "experiments/taking_turns.hpp"

#include "foundation/stopwatch.hpp"

#include <algorithm>

namespace radiosity {

double Competitor::seconds_min() const {
  return *std::min_element(seconds.begin(), seconds.end());
}

double Competitor::seconds_median() const {
  std::vector<double> sorted = seconds;
  std::sort(sorted.begin(), sorted.end());
  return sorted[sorted.size() / 2];
}

double Competitor::gigabytes_per_second() const {
  return 1e-9 * static_cast<double>(bytes) / seconds_min();
}

int take_turns(std::vector<Competitor>& competitors, double seconds) {
  for (Competitor& competitor : competitors) competitor.seconds.clear();
  int repetitions = 0;
  const Stopwatch total;
  do {
    for (Competitor& competitor : competitors)
      for (int turn = 0; turn < competitor.turns; ++turn) {
        const Stopwatch watch;
        competitor.work();
        competitor.seconds.push_back(watch.seconds());
      }
    ++repetitions;
  } while (total.seconds() < seconds);
  return repetitions;
}

}  // namespace radiosity

#pragma once

#include <cstddef>
#include <vector>

namespace radiosity {

/// Which of the scores of one list belong to the largest over all lists: those above `above` and the first
/// `ties` that equal it.
struct ScoreCut {
  float above = 0;
  std::size_t ties = 0;

  /// Asked once for each score of the list, in order.
  bool takes(float score) {
    if (score != above) return score > above;
    if (ties == 0) return false;
    --ties;
    return true;
  }
};

/// Cuts many lists of scores >= 0 so that the `wanted` largest of all are taken, ties in the order of the
/// lists; zeros are never taken. One cut a list.
std::vector<ScoreCut> cut_to_largest(const std::vector<std::vector<float>>& lists, std::size_t wanted);

}  // namespace radiosity

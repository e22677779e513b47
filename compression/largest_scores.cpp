#include "compression/largest_scores.hpp"

#include <algorithm>
#include <functional>
#include <limits>

namespace radiosity {

std::vector<ScoreCut> cut_to_largest(const std::vector<std::vector<float>>& lists, std::size_t wanted) {
  std::vector<ScoreCut> cuts(lists.size());
  std::size_t count = 0;
  for (const std::vector<float>& list : lists) count += list.size();
  std::vector<float> all;
  all.reserve(count);
  for (const std::vector<float>& list : lists)
    std::copy_if(list.begin(), list.end(), std::back_inserter(all), [](float score) { return score > 0; });
  if (wanted >= all.size()) return cuts;
  const auto limit = all.begin() + static_cast<std::ptrdiff_t>(wanted);
  std::nth_element(all.begin(), limit, all.end(), std::greater<>());
  const float above = *limit;
  auto left = static_cast<std::size_t>(std::count(all.begin(), limit, above));
  for (std::size_t k = 0; k < lists.size(); ++k) {
    const auto equal = static_cast<std::size_t>(std::count(lists[k].begin(), lists[k].end(), above));
    cuts[k] = {above, std::min(equal, left)};
    left -= cuts[k].ties;
  }
  return cuts;
}

}  // namespace radiosity
